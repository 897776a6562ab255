#include "ui/experiment/parameter_text.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "ui/common/numbers/number_entry.h"

namespace btr::ui {
namespace {

// The letters and digits of a unit as names spell it: "m/(s·N)" → "msn", "m/s²" → "ms2".
QString plainUnit(const QString& unit) {
  QString plain;
  for (const QChar c : unit) {
    if (c == QChar(u'²'))
      plain += '2';
    else if (c == QChar(u'³'))
      plain += '3';
    else if (c == QChar(u'°'))
      plain += QStringLiteral("deg");
    else if (c == '%')
      plain += QStringLiteral("percent");
    else if (c.isLetterOrNumber())
      plain += c.toLower();
  }
  // "1/rad²" is spelled "rad2".
  return plain.size() > 1 && plain.startsWith('1') ? plain.mid(1) : plain;
}

QString number(double value) { return QString::fromStdString(toText(value)); }

}  // namespace

QString labelOf(const Parameter& parameter) {
  QStringList words = QString::fromStdString(parameter.name).split('_', Qt::SkipEmptyParts);
  const QString unit = plainUnit(QString::fromStdString(parameter.unit));
  QString tail;
  for (int i = int(words.size()) - 1; i > 0 && !unit.isEmpty() && tail.size() < unit.size(); --i) {
    tail.prepend(words[i].toLower());
    if (tail == unit) {
      words = words.mid(0, i);
      break;
    }
  }
  QString label = words.join(' ');
  if (!label.isEmpty()) label[0] = label[0].toUpper();
  return label;
}

QString allowedText(const Parameter& parameter) {
  if (!parameter.choices.empty()) {
    QStringList words;
    for (const auto& choice : parameter.choices) words << QString::fromStdString(choice);
    const QString last = words.takeLast();
    return words.isEmpty() ? last : words.join(QStringLiteral(", ")) + QStringLiteral(" or ") + last;
  }
  const QString unit = parameter.unit.empty() ? QString() : QChar(' ') + QString::fromStdString(parameter.unit);
  return QStringLiteral("%1 from %2 to %3%4")
      .arg(parameter.integer ? QStringLiteral("a whole number") : QStringLiteral("a number"), number(parameter.minimum),
           number(parameter.maximum), unit);
}

QString fieldText(const Parameter& parameter, double value) {
  if (!parameter.choices.empty()) {
    const auto index = static_cast<std::size_t>(std::clamp(value, 0.0, double(parameter.choices.size() - 1)));
    return QString::fromStdString(parameter.choices[index]);
  }
  return number(value);
}

std::optional<double> fieldValue(const Parameter& parameter, const QString& text) {
  if (!parameter.choices.empty()) {
    const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), text.toStdString());
    if (found == parameter.choices.end()) return {};
    return double(found - parameter.choices.begin());
  }
  const auto value = readNumber(text).value;
  if (!value || *value < parameter.minimum || *value > parameter.maximum) return {};
  if (parameter.integer && *value != std::floor(*value)) return {};
  return value;
}

QString toolTipOf(const Parameter& parameter) {
  QString range = allowedText(parameter);
  range[0] = range[0].toUpper();
  const QString unit = parameter.unit.empty() ? QString() : QChar(' ') + QString::fromStdString(parameter.unit);
  return QStringLiteral("<p>%1.</p><p>%2; default %3%4.</p><p><tt>%5</tt></p>")
      .arg(QString::fromStdString(parameter.meaning).toHtmlEscaped(), range.toHtmlEscaped(),
           fieldText(parameter, parameter.byDefault).toHtmlEscaped(), unit.toHtmlEscaped(),
           QString::fromStdString(parameter.name).toHtmlEscaped());
}

}  // namespace btr::ui
