#include "ui/common/numbers/decimal_spin_box.h"

#include <QLocale>

namespace btr::ui {

DecimalSpinBox::DecimalSpinBox(QWidget* parent) : QDoubleSpinBox(parent) {
  QLocale plain = QLocale::c();
  plain.setNumberOptions(QLocale::OmitGroupSeparator);
  setLocale(plain);
}

QValidator::State DecimalSpinBox::validate(QString& text, int& position) const {
  // "1.234,5" could mean two numbers: its comma stays and is refused.
  if (text.count(',') == 1 && !text.contains('.')) text.replace(',', '.');
  return QDoubleSpinBox::validate(text, position);
}

}  // namespace btr::ui
