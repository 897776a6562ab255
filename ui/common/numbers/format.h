#pragma once
#include <QString>
#include <cmath>
#include <string>

namespace btr::ui {

constexpr double inDegrees = 180 / M_PI;

/// A word of the core.
inline QString word(const std::string& text) { return QString::fromStdString(text); }

/// A name as menus, buttons and tabs show it: there a single & underlines a letter.
QString inMenu(QString name);

/// What core/spec/figures wrote, with a true minus.
QString forPeople(const std::string& figures);
/// A number for people: four significant digits, C locale, a true minus, "–" if it is not finite.
QString shortNumber(double value);
/// "0.123 m"; without a unit just the number.
QString withUnit(double value, const QString& unit);
/// "−20.1°" for an angle in rad.
QString degrees(double rad);
/// "2 h 05 min", "3 min 20 s", "12 s"; "–" for negative (not known).
QString duration(double seconds);

}  // namespace btr::ui
