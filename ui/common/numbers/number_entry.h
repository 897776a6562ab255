#pragma once
#include <QString>
#include <optional>

namespace btr::ui {

/// A number as a person typed it. `text` is what is kept and shown: without spaces around it, with a decimal point
/// where a comma was typed ("0,53" becomes "0.53") and a plain minus. `value` is absent if that is not one finite
/// number.
struct NumberEntry {
  QString text;
  std::optional<double> value;
  bool converted = false;  ///< the comma was changed: worth telling
};
NumberEntry readNumber(const QString& typed);

/// What may be entered; unset ends are open.
struct AllowedRange {
  std::optional<double> from, to;
  bool contains(double value) const { return (!from || value >= *from) && (!to || value <= *to); }
  /// "a number from 0 to 3 in m"
  QString text(const QString& unit) const;
};

}  // namespace btr::ui
