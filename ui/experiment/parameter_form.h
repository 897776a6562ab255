#pragma once
#include <QWidget>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/spec/parameter.h"

class QLabel;
class QLineEdit;
class QUndoStack;

namespace btr::ui {
class ParameterField;

/// A form made from declared parameters. What differs from its default is bold and can be reset; what is not allowed is
/// marked where it stands. Every edit is one step on the undo stack, which is borrowed and must not outlive the form.
class ParameterForm : public QWidget {
  Q_OBJECT
 public:
  struct Options {
    bool checkable = false;  ///< a box before each field: which of them L3 may change
    int filterFrom = 9;      ///< from so many fields on, a search field stands above
  };
  ParameterForm(const std::vector<Parameter>& parameters, QUndoStack& undo, const Options& options,
                QWidget* parent = nullptr);
  ParameterForm(const std::vector<Parameter>& parameters, QUndoStack& undo, QWidget* parent = nullptr)
      : ParameterForm(parameters, undo, Options{}, parent) {}

  /// Names that are not declared are kept and given back by values(). Not an undo step.
  void setValues(const Values& values);
  /// What was set, also where it equals the default; what is not allowed is left out (see isValid()).
  Values values() const;
  /// The texts that values() leaves out because they are not allowed, by name, to be shown again by setTexts().
  std::map<std::string, QString> refused() const;
  /// As if they were typed, but no undo step; names that are not declared are passed over.
  void setTexts(const std::map<std::string, QString>& texts);
  bool isValid() const;
  QStringList problems() const;  ///< "Population: 1 is not allowed; …"

  void setChecked(const std::set<std::string>& names);
  std::set<std::string> checked() const;

  /// Only these fields are shown; the others keep what they have. At first all are.
  void setShown(const std::set<std::string>& names);
  bool shows(const std::string& name) const { return !shown_ || shown_->count(name) > 0; }

  void setReadOnly(bool readOnly);
  int changedCount() const;  ///< fields that differ from their defaults
  void resetAll();           ///< one undo step
  ParameterField* field(const std::string& name) const;

 signals:
  void changed(const btr::Values& values);
  void validChanged(bool valid);

 private:
  void edit(ParameterField& field, const std::optional<QString>& text);
  void announce();
  void filter(const QString& text);

  QUndoStack& undo_;
  std::vector<ParameterField*> fields_;
  std::optional<std::set<std::string>> shown_;
  Values undeclared_;
  bool wasValid_ = true;
  QLineEdit* search_;
  QLabel* nothing_;
};

}  // namespace btr::ui
