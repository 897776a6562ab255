#pragma once
#include <QWidget>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

class QLabel;
class QSlider;
class QToolButton;

namespace btr::ui {
class NumberEdit;

/// Declared parameters with a slider, a number and a way back each, for what takes effect while it is moved. What
/// differs from the value to go back to is bold. A slider of very wide bounds spans what is usual; the number reaches
/// all.
class SliderForm : public QWidget {
  Q_OBJECT
 public:
  explicit SliderForm(QWidget* parent = nullptr);

  /// `usual`: the values to go back to; a name that is absent has its declared default. The same ones again change
  /// nothing.
  void setParameters(const std::vector<Parameter>& parameters, const Values& usual);
  /// Those that were set. A number that is being typed and a slider that is held stay.
  void setValues(const Values& values);
  const Values& values() const { return values_; }
  int changedCount() const;
  double value(const std::string& name) const;

 signals:
  /// By the user; none: it goes back.
  void edited(const std::string& name, std::optional<double> value);
  void dragBegan();
  void dragEnded();

 private:
  struct Line {
    Parameter parameter;
    double usual = 0, low = 0, high = 1;  ///< the slider's ends
    QLabel* label = nullptr;
    QSlider* slider = nullptr;
    NumberEdit* number = nullptr;
    QToolButton* back = nullptr;
  };
  void add(const Parameter& parameter, double usual);
  void show(Line& line);
  void giveUp(std::size_t line);
  void set(std::size_t line, std::optional<double> value);

  std::vector<Line> lines_;
  Values values_, usual_;
  QWidget* content_ = nullptr;
  QLabel* refused_;  ///< what was typed last and is not allowed
};

}  // namespace btr::ui
