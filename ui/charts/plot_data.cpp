#include "ui/charts/plot_data.h"

#include <QLocale>
#include <QRegularExpression>

namespace btr::ui {

QString columnName(const QString& quantity, const QString& unit) {
  static const QRegularExpression notPlain("[^A-Za-z0-9]+");
  QString suffix = unit;
  suffix.replace("·", "").replace(notPlain, "_");
  while (suffix.endsWith('_')) suffix.chop(1);
  return suffix.isEmpty() ? quantity : quantity + '_' + suffix.toLower();
}

QString axisTitle(const QString& quantity, const QString& unit) {
  return unit.isEmpty() ? quantity : quantity + " (" + unit + ')';
}

QString exactText(double value) { return QLocale::c().toString(value, 'g', QLocale::FloatingPointShortest); }

}  // namespace btr::ui
