#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace btr {

/// A number that a user, a fit or an evolution may choose, declared once by the code that uses it. Form, command line,
/// JSON check, bit coding, optimiser bounds, database rows and reports are all made from this declaration.
struct Parameter {
  std::string name;     ///< as in files: letters, digits, underscore; ends in its unit where it has one, e.g. "mass_kg"
  std::string unit;     ///< for people: "kg", "N·m", "" for none
  std::string meaning;  ///< one short sentence without a full stop
  double minimum = 0;
  double maximum = 1;
  double byDefault = 0;                   ///< within [minimum, maximum]
  std::optional<double> neutral = {};     ///< the value at which an effect does nothing
  bool integer = false;                   ///< only whole numbers
  std::vector<std::string> choices = {};  ///< not empty: the value is the index of one of these words
  bool refines = false;  ///< a detail of an effect's law: an analysis fits it once the effect has been found, and keeps
                         ///< its default until then
};

/// Values by parameter name. A name that is absent has its default.
using Values = std::map<std::string, double>;

/// The declared parameter of that name, or nullptr.
const Parameter* find(std::span<const Parameter> declared, const std::string& name);

/// The value of `name` in `values`, or its declared default. Asserts that the name is declared.
double valueOf(std::span<const Parameter> declared, const Values& values, const std::string& name);

/// All declared parameters in their order, defaults filled in. Throws InputError (prefixed by `place`) for a name that
/// is not declared, a value that is not finite, out of its bounds or not whole.
std::vector<double> resolve(std::span<const Parameter> declared, const Values& values, const std::string& place);

/// Throws InputError if `value` is not allowed for `parameter`; `place` begins the message.
void check(const Parameter& parameter, double value, const std::string& place);

/// Shortest text that reads back as the same double (whole numbers below 1e9 in plain digits), independent of the
/// locale.
std::string toText(double value);
/// The whole of `text` as a finite double, or nothing. Independent of the locale.
std::optional<double> toNumber(const std::string& text);

}  // namespace btr
