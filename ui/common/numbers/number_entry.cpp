#include "ui/common/numbers/number_entry.h"

#include <QCoreApplication>

#include "core/spec/parameter.h"

namespace btr::ui {

NumberEntry readNumber(const QString& typed) {
  NumberEntry entry;
  entry.text = typed.trimmed();
  entry.text.replace(QChar(0x2212), '-');

  // A comma is the decimal point unless a point stands beside it: "1.234,5" could mean two numbers and is refused.
  if (entry.text.count(',') == 1 && !entry.text.contains('.')) {
    QString pointed = entry.text;
    pointed.replace(',', '.');
    if (toNumber(pointed.toStdString())) {
      entry.text = pointed;
      entry.converted = true;
    }
  }
  entry.value = toNumber(entry.text.toStdString());
  return entry;
}

QString AllowedRange::text(const QString& unit) const {
  const auto say = [](const char* words) { return QCoreApplication::translate("AllowedRange", words); };
  QString range = say("a number");
  if (from && to)
    range = say("a number from %1 to %2").arg(*from).arg(*to);
  else if (from)
    range = say("a number of at least %1").arg(*from);
  else if (to)
    range = say("a number of at most %1").arg(*to);
  if (!unit.isEmpty()) range += say(" in %1").arg(unit);
  return range;
}

}  // namespace btr::ui
