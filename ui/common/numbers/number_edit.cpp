#include "ui/common/numbers/number_edit.h"

#include <QLineEdit>
#include <QStyle>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/common/look/theme.h"
#include "ui/common/numbers/number_entry.h"

namespace btr::ui {

NumberEdit::NumberEdit(QWidget* parent) : QAbstractSpinBox(parent) {
  setFocusPolicy(Qt::StrongFocus);
  lineEdit()->setAlignment(Qt::AlignRight);
  connect(lineEdit(), &QLineEdit::textEdited, this, &NumberEdit::edited);
  connect(this, &QAbstractSpinBox::editingFinished, this, &NumberEdit::showPoint);
}

void NumberEdit::showPoint() {
  const NumberEntry typed = readNumber(numberText());
  if (!typed.converted) return;
  setNumberText(typed.text);
  emit edited(typed.text);
}

void NumberEdit::setRange(double minimum, double maximum, bool integer) {
  minimum_ = minimum;
  maximum_ = maximum;
  integer_ = integer;
}

QString NumberEdit::numberText() const { return lineEdit()->text(); }

void NumberEdit::setNumberText(const QString& text) {
  if (lineEdit()->text() == text) return;
  lineEdit()->setText(text);
  if (!hasFocus()) lineEdit()->setCursorPosition(0);
}

void NumberEdit::setMarked(bool marked) {
  const QString sheet =
      marked
          ? QStringLiteral("QLineEdit { border: 1px solid %1; border-radius: 2px; }").arg(tonesOf(palette()).bad.name())
          : QString();
  if (lineEdit()->styleSheet() != sheet) lineEdit()->setStyleSheet(sheet);
}

void NumberEdit::stepBy(int steps) {
  const auto now = readNumber(numberText()).value;
  // A hundredth of the range, rounded down to a power of ten, so that stepping gives round numbers.
  const double step = integer_ ? 1 : std::pow(10.0, std::floor(std::log10(std::max(maximum_ - minimum_, 1e-12) / 50)));
  double next = now ? std::round((*now + steps * step) / step) * step : minimum_;
  next = std::clamp(next, minimum_, maximum_);
  // Twelve digits: the product above may leave 0.30000000000000004.
  const QString text = QString::number(next, 'g', integer_ ? 17 : 12);
  setNumberText(text);
  emit edited(text);
}

QSize NumberEdit::sizeHint() const {
  QSize size = QAbstractSpinBox::sizeHint();
  size.setWidth(fontMetrics().horizontalAdvance(QStringLiteral("000000000000")) + 30);
  return size;
}

QAbstractSpinBox::StepEnabled NumberEdit::stepEnabled() const {
  if (isReadOnly()) return StepNone;
  const auto now = readNumber(lineEdit()->text()).value;
  if (!now) return StepUpEnabled | StepDownEnabled;
  StepEnabled enabled = StepNone;
  if (*now < maximum_) enabled |= StepUpEnabled;
  if (*now > minimum_) enabled |= StepDownEnabled;
  return enabled;
}

QValidator::State NumberEdit::validate(QString&, int&) const { return QValidator::Acceptable; }

void NumberEdit::wheelEvent(QWheelEvent* event) {
  if (hasFocus())
    QAbstractSpinBox::wheelEvent(event);
  else
    event->ignore();
}

}  // namespace btr::ui
