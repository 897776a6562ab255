#pragma once
#include <QObject>
#include <optional>

#include "core/spec/parameter.h"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QToolButton;

namespace btr::ui {
class NumberEdit;

/// One line of a ParameterForm: label, editor, unit, reset button, and below them what is wrong. Its state is the text
/// that was typed, or nothing: then it shows, and follows, the default. The widgets belong to the form.
class ParameterField : public QObject {
  Q_OBJECT
 public:
  ParameterField(const Parameter& parameter, bool checkable, QWidget* form);
  /// Puts the widgets into two rows of the grid.
  void place(QGridLayout& grid, int row);

  const Parameter& parameter() const { return parameter_; }
  const std::optional<QString>& text() const { return text_; }
  void setText(const std::optional<QString>& text);
  bool isChecked() const;
  void setChecked(bool checked);

  /// The allowed value, the default if nothing was typed, or nothing if the text is not allowed.
  std::optional<double> value() const;
  QString problem() const;  ///< empty if allowed
  bool differsFromDefault() const;

  void setReadOnly(bool readOnly);
  void setVisible(bool visible);
  bool matches(const QString& filter) const;
  int visit() const { return visit_; }
  QWidget* editor() const;

 signals:
  void edited(const std::optional<QString>& text);  ///< by the user; setText() follows from the form
  void checkEdited(bool checked);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void show();

  Parameter parameter_;
  std::optional<QString> text_;
  bool visible_ = true, readOnly_ = false;
  int visit_ = 0;  ///< counts how often the editor got the focus: edits of one visit are one undo step
  QCheckBox* check_ = nullptr;
  QLabel* label_;
  NumberEdit* number_ = nullptr;
  QComboBox* choice_ = nullptr;
  QLabel* unit_;
  QToolButton* reset_;
  QLabel* problem_;
};

}  // namespace btr::ui
