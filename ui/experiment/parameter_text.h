#pragma once
#include <QString>

#include "core/spec/parameter.h"

namespace btr::ui {

/// "leg_mass_kg" with unit "kg" → "Leg mass": the name for people; the unit stands beside the field.
QString labelOf(const Parameter& parameter);
/// "a number from 0.1 to 0.5 kg", "a whole number from 2 to 1000", "binary or gray".
QString allowedText(const Parameter& parameter);
/// The value as the field shows it: the word of a choice, else the shortest text that reads back as the same number.
QString fieldText(const Parameter& parameter, double value);
/// The value that the text means, if it is allowed.
std::optional<double> fieldValue(const Parameter& parameter, const QString& text);
/// Meaning, range, default and the name as in files, as a tooltip.
QString toolTipOf(const Parameter& parameter);

}  // namespace btr::ui
