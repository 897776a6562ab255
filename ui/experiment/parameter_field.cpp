#include "ui/experiment/parameter_field.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>

#include "ui/common/form_undo.h"
#include "ui/common/look/combo_width.h"
#include "ui/common/look/style_sheet.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/number_edit.h"
#include "ui/common/wheel_guard.h"
#include "ui/experiment/parameter_text.h"

namespace btr::ui {

ParameterField::ParameterField(const Parameter& parameter, bool checkable, QWidget* form)
    : QObject(form),
      parameter_(parameter),
      label_(new QLabel(labelOf(parameter), form)),
      unit_(new QLabel(QString::fromStdString(parameter.unit), form)),
      reset_(new QToolButton(form)),
      problem_(new QLabel(form)) {
  WheelGuard::ensure();
  const QString name = QString::fromStdString(parameter.name);
  const QString toolTip = toolTipOf(parameter);
  if (checkable) {
    check_ = new QCheckBox(form);
    check_->setObjectName(name + ".adapt");
    check_->setToolTip(tr("L3 may change this parameter"));
    check_->setAccessibleName(tr("L3 may change %1").arg(labelOf(parameter)));
    connect(check_, &QCheckBox::clicked, this, &ParameterField::checkEdited);
  }
  if (parameter.choices.empty()) {
    number_ = new NumberEdit(form);
    number_->setRange(parameter.minimum, parameter.maximum, parameter.integer);
    connect(number_, &NumberEdit::edited, this, [this](const QString& text) { emit edited(text); });
    // A spin box hands the key to its line directly, past the line's own filters.
    leaveUndoToForm(number_);
    leaveUndoToForm(number_->findChild<QLineEdit*>());
    number_->findChild<QLineEdit*>()->installEventFilter(this);
  } else {
    choice_ = new QComboBox(form);
    choice_->setFocusPolicy(Qt::StrongFocus);
    letShrink(*choice_);
    for (const auto& word : parameter.choices) choice_->addItem(QString::fromStdString(word).replace('_', ' '));
    connect(choice_, &QComboBox::activated, this, [this](int index) {
      emit edited(QString::fromStdString(parameter_.choices[static_cast<std::size_t>(index)]));
    });
  }
  editor()->setObjectName(name);
  editor()->installEventFilter(this);
  const QString unit = parameter.unit.empty() ? QString() : QStringLiteral(" [%1]").arg(unit_->text());
  editor()->setAccessibleName(labelOf(parameter) + unit);
  editor()->setAccessibleDescription(QString::fromStdString(parameter.meaning) + "; " + allowedText(parameter));
  label_->setBuddy(editor());
  label_->setWordWrap(true);
  for (QWidget* widget : {static_cast<QWidget*>(label_), editor(), static_cast<QWidget*>(unit_)})
    widget->setToolTip(toolTip);

  reset_->setObjectName(name + ".reset");
  reset_->setIcon(themeIcon("edit-undo"));
  reset_->setAutoRaise(true);
  reset_->setFocusPolicy(Qt::NoFocus);
  reset_->setToolTip(tr("Back to the default, %1%2").arg(fieldText(parameter, parameter.byDefault), unit));
  reset_->setAccessibleName(tr("Reset %1").arg(labelOf(parameter)));
  connect(reset_, &QToolButton::clicked, this, [this] {
    ++visit_;
    emit edited(std::nullopt);
  });
  QSizePolicy keepsItsPlace = reset_->sizePolicy();
  keepsItsPlace.setRetainSizeWhenHidden(true);
  reset_->setSizePolicy(keepsItsPlace);

  problem_->setObjectName(name + ".problem");
  problem_->setWordWrap(true);
  show();
}

QWidget* ParameterField::editor() const {
  return number_ ? static_cast<QWidget*>(number_) : static_cast<QWidget*>(choice_);
}

void ParameterField::place(QGridLayout& grid, int row) {
  if (check_) grid.addWidget(check_, row, 0);
  grid.addWidget(label_, row, 1);
  grid.addWidget(editor(), row, 2);
  grid.addWidget(unit_, row, 3);
  grid.addWidget(reset_, row, 4);
  grid.addWidget(problem_, row + 1, 1, 1, 4);
}

void ParameterField::setText(const std::optional<QString>& text) {
  text_ = text;
  show();
}

bool ParameterField::isChecked() const { return check_ && check_->isChecked(); }
void ParameterField::setChecked(bool checked) {
  if (check_) check_->setChecked(checked);
}

std::optional<double> ParameterField::value() const {
  return text_ ? fieldValue(parameter_, *text_) : std::optional(parameter_.byDefault);
}

QString ParameterField::problem() const {
  if (value()) return {};
  const QString typed = text_->trimmed();
  return (typed.isEmpty() ? tr("The field is empty") : tr("%1 is not allowed").arg(typed)) + "; " +
         allowedText(parameter_);
}

bool ParameterField::differsFromDefault() const { return value() != parameter_.byDefault; }

void ParameterField::setReadOnly(bool readOnly) {
  readOnly_ = readOnly;
  if (number_) {
    number_->setReadOnly(readOnly);
    number_->setButtonSymbols(readOnly ? QAbstractSpinBox::NoButtons : QAbstractSpinBox::UpDownArrows);
  }
  if (choice_) choice_->setEnabled(!readOnly);
  if (check_) check_->setEnabled(!readOnly);
  show();
}

void ParameterField::setVisible(bool visible) {
  visible_ = visible;
  for (QWidget* widget : {static_cast<QWidget*>(label_), editor(), static_cast<QWidget*>(unit_)})
    widget->setVisible(visible);
  if (check_) check_->setVisible(visible);
  show();
}

bool ParameterField::matches(const QString& filter) const {
  const auto in = [&](const QString& text) { return text.contains(filter, Qt::CaseInsensitive); };
  return in(label_->text()) || in(QString::fromStdString(parameter_.name)) ||
         in(QString::fromStdString(parameter_.meaning));
}

bool ParameterField::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusIn) ++visit_;
  return QObject::eventFilter(watched, event);
}

// Everything that is seen follows from the text: the editor, bold, the reset button and the mark.
void ParameterField::show() {
  const QString shown = text_ ? *text_ : fieldText(parameter_, parameter_.byDefault);
  if (number_) number_->setNumberText(shown);
  if (choice_) {
    const auto index = fieldValue(parameter_, shown);
    choice_->setCurrentIndex(index ? static_cast<int>(*index) : -1);
  }
  QFont weight = label_->font();
  weight.setBold(differsFromDefault());
  label_->setFont(weight);
  reset_->setVisible(visible_ && differsFromDefault() && !readOnly_);
  const QString wrong = problem();
  if (number_) number_->setMarked(!wrong.isEmpty());
  problem_->setText(wrong);
  styleOnce(*problem_, QStringLiteral("color: %1").arg(tonesOf(label_->palette()).bad.name()));
  problem_->setVisible(visible_ && !wrong.isEmpty());
}

}  // namespace btr::ui
