#include "ui/common/numbers/format.h"

#include <cmath>

#include "core/spec/figures.h"

namespace btr::ui {

QString inMenu(QString name) { return name.replace('&', QStringLiteral("&&")); }

QString forPeople(const std::string& figures) { return QString::fromStdString(figures).replace('-', QChar(u'−')); }

QString shortNumber(double value) { return forPeople(brief(value)); }

QString withUnit(double value, const QString& unit) {
  if (unit.isEmpty() || !std::isfinite(value)) return shortNumber(value);
  return shortNumber(value) + QChar(0x202f) + unit;  // a narrow space keeps number and unit together
}

QString degrees(double rad) { return shortNumber(std::round(10 * inDegrees * rad) / 10) + QChar(u'°'); }

QString duration(double seconds) {
  if (!(seconds >= 0) || !std::isfinite(seconds)) return QStringLiteral("–");
  const auto whole = static_cast<long long>(std::ceil(seconds));
  const auto two = [](long long number) { return QStringLiteral("%1").arg(number, 2, 10, QLatin1Char('0')); };
  if (whole >= 3600) return QStringLiteral("%1 h %2 min").arg(whole / 3600).arg(two(whole % 3600 / 60));
  if (whole >= 60) return QStringLiteral("%1 min %2 s").arg(whole / 60).arg(two(whole % 60));
  return QStringLiteral("%1 s").arg(whole);
}

}  // namespace btr::ui
