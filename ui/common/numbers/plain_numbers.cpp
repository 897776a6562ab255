#include "ui/common/numbers/plain_numbers.h"

#include <QLocale>
#include <clocale>

namespace btr::ui {

void usePlainNumbers() {
  QLocale::setDefault(QLocale::c());
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace btr::ui
