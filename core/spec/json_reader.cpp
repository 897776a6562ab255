#include "core/spec/json_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/spec/error.h"

namespace btr {
namespace {

using nlohmann::json;
constexpr std::size_t deepest = 100;
constexpr double wholeLimit = 9007199254740992;  // 2^53: above it doubles skip whole numbers

/// "3:14" for the 1-based number of a byte in `text`.
std::string lineAndColumn(const std::string& text, std::size_t byte) {
  const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const std::size_t lineStart = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t column = end - (lineStart == std::string::npos ? 0 : lineStart + 1) + 1;
  return std::to_string(line) + ":" + std::to_string(column);
}

std::string shortened(std::string text, std::size_t length = 120) {
  if (text.size() > length) text = text.substr(0, length) + "…";
  return text;
}

/// 1e400 of "number overflow parsing '1e400'".
std::string betweenQuotes(const std::string& text) {
  const std::size_t first = text.find('\''), last = text.rfind('\'');
  return last > first ? text.substr(first + 1, last - first - 1) : "";
}

/// What the parser says, without its own prefixes.
std::string complaint(const std::exception& error) {
  std::string text = error.what();
  if (const std::size_t at = text.find("syntax error"); at != std::string::npos) text = text.substr(at);
  return shortened(text, 240);
}

/// Refuses two equal keys in one object (the parser would silently keep the last) and endless nesting.
class Strictness {
 public:
  explicit Strictness(std::string place) : place_(std::move(place)) {}

  bool operator()(int, json::parse_event_t event, json& parsed) {
    using Event = json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) {
      if (keys_.size() == deepest)
        throw InputError(place_ + ": nested deeper than the allowed " + std::to_string(deepest) + " levels");
      keys_.emplace_back();
    } else if (event == Event::object_end || event == Event::array_end) {
      keys_.pop_back();
    } else if (event == Event::key && !keys_.back().insert(parsed.get<std::string>()).second) {
      throw InputError(place_ + ": key " + shortened(parsed.dump()) + " is there twice in one object");
    }
    return true;
  }

 private:
  std::string place_;
  std::vector<std::set<std::string>> keys_;
};

std::string rangeText(double minimum, double maximum) { return toText(minimum) + " to " + toText(maximum); }

}  // namespace

JsonReader JsonReader::parse(const std::string& text, const std::string& place) {
  // The parser would take a zero byte for the end of the text.
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
    throw InputError(place + ":" + lineAndColumn(text, zero + 1) + ": not JSON: a zero byte");
  try {
    auto document = std::make_shared<const json>(json::parse(text, Strictness(place)));
    const json* root = document.get();
    return {std::move(document), root, place};
  } catch (const json::parse_error& error) {
    throw InputError(place + ":" + lineAndColumn(text, error.byte) + ": not JSON: " + complaint(error));
  } catch (const json::out_of_range& error) {
    // The only such error of a parser: a number beyond the largest double. It names the number, not its place.
    const std::string number = betweenQuotes(error.what());
    throw InputError(place + ":" + lineAndColumn(text, text.find(number) + 1), shortened(number),
                     "numbers up to " + toText(std::numeric_limits<double>::max()));
  } catch (const json::exception& error) {
    throw InputError(place + ": not JSON: " + complaint(error));
  }
}

JsonReader JsonReader::open(const std::string& path) { return parse(readFile(path), path); }

JsonReader::JsonReader(std::shared_ptr<const json> document, const json* node, std::string place)
    : document_(std::move(document)), node_(node), place_(std::move(place)) {
  if (!node_->is_object()) throw InputError(place_, shortened(node_->dump()), "an object { … }");
}

std::string JsonReader::at(const std::string& key) const {
  return place_ + (node_ == document_.get() ? " /" : "/") + shortened(key);
}

bool JsonReader::has(const std::string& key) const { return node_->contains(key); }

const json* JsonReader::get(const std::string& key) {
  asked_.push_back(key);
  const auto found = node_->find(key);
  return found == node_->end() ? nullptr : &*found;
}

const json& JsonReader::need(const std::string& key) {
  const json* value = get(key);
  if (!value) throw InputError(at(key) + ": is missing");
  return *value;
}

void JsonReader::refuse(const std::string& key, const std::string& allowed) const {
  const auto value = node_->find(key);
  throw InputError(at(key), value == node_->end() ? "nothing" : shortened(value->dump()), allowed);
}

double JsonReader::number(const std::string& key, double minimum, double maximum) {
  const json& value = need(key);
  if (!value.is_number()) refuse(key, "a number " + rangeText(minimum, maximum));
  const double number = value.get<double>();
  if (!(std::isfinite(number) && number >= minimum && number <= maximum)) refuse(key, rangeText(minimum, maximum));
  return number;
}

double JsonReader::number(const std::string& key, double minimum, double maximum, double byDefault) {
  return get(key) ? number(key, minimum, maximum) : byDefault;
}

double JsonReader::numberOrNull(const std::string& key, double unknown) {
  const json& value = need(key);
  if (value.is_null()) return unknown;
  if (!value.is_number()) refuse(key, "a number or null");
  return value.get<double>();
}

long long JsonReader::integer(const std::string& key, long long minimum, long long maximum) {
  const json& value = need(key);
  const std::string allowed = "whole numbers " + std::to_string(minimum) + " to " + std::to_string(maximum);
  // 50.0 and 5e1 are whole numbers too.
  long long whole = 0;
  if (value.is_number_unsigned()) {
    if (value.get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<long long>::max()))
      refuse(key, allowed);
    whole = value.get<long long>();
  } else if (value.is_number_integer()) {
    whole = value.get<long long>();
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number != std::floor(number) || std::abs(number) > wholeLimit) refuse(key, allowed);
    whole = static_cast<long long>(number);
  } else {
    refuse(key, allowed);
  }
  if (whole < minimum || whole > maximum) refuse(key, allowed);
  return whole;
}

long long JsonReader::integer(const std::string& key, long long minimum, long long maximum, long long byDefault) {
  return get(key) ? integer(key, minimum, maximum) : byDefault;
}

std::uint64_t JsonReader::seed(const std::string& key, std::uint64_t byDefault) {
  const json* value = get(key);
  if (!value) return byDefault;
  if (!value->is_number_unsigned()) refuse(key, "whole numbers 0 to 18446744073709551615");
  return value->get<std::uint64_t>();
}

bool JsonReader::flag(const std::string& key, bool byDefault) {
  const json* value = get(key);
  if (!value) return byDefault;
  if (!value->is_boolean()) refuse(key, "true or false");
  return value->get<bool>();
}

std::string JsonReader::text(const std::string& key) {
  const json& value = need(key);
  if (!value.is_string()) refuse(key, "a text \"…\"");
  return value.get<std::string>();
}

std::string JsonReader::text(const std::string& key, const std::string& byDefault) {
  return get(key) ? text(key) : byDefault;
}

std::string JsonReader::word(const std::string& key, const std::vector<std::string>& words) {
  const json& value = need(key);
  if (!value.is_string() || std::find(words.begin(), words.end(), value.get<std::string>()) == words.end()) {
    std::string allowed = "one of ";
    for (std::size_t i = 0; i < words.size(); ++i) allowed += (i ? ", " : "") + words[i];
    refuse(key, allowed);
  }
  return value.get<std::string>();
}

std::string JsonReader::word(const std::string& key, const std::vector<std::string>& words,
                             const std::string& byDefault) {
  return get(key) ? word(key, words) : byDefault;
}

std::vector<double> JsonReader::numbers(const std::string& key, std::size_t count) {
  const json& value = need(key);
  const std::string allowed = "a list of " + std::to_string(count) + " numbers";
  if (!value.is_array() || value.size() != count) refuse(key, allowed);
  std::vector<double> numbers;
  for (const json& element : value) {
    if (!element.is_number()) refuse(key, allowed);
    numbers.push_back(element.get<double>());
  }
  return numbers;
}

std::vector<double> JsonReader::numbers(const std::string& key, std::size_t count,
                                        const std::vector<double>& byDefault) {
  return get(key) ? numbers(key, count) : byDefault;
}

std::vector<double> JsonReader::numberList(const std::string& key) {
  std::vector<double> numbers;
  const json* value = get(key);
  if (!value) return numbers;
  if (!value->is_array()) refuse(key, "a list of numbers");
  for (const json& element : *value) {
    if (!element.is_number() && !element.is_null()) refuse(key, "a list of numbers");
    numbers.push_back(element.is_null() ? std::numeric_limits<double>::quiet_NaN() : element.get<double>());
  }
  return numbers;
}

std::vector<std::string> JsonReader::texts(const std::string& key) {
  const json* value = get(key);
  if (!value) return {};
  std::vector<std::string> texts;
  if (!value->is_array()) refuse(key, "a list of texts");
  for (const json& element : *value) {
    if (!element.is_string()) refuse(key, "a list of texts");
    texts.push_back(element.get<std::string>());
  }
  return texts;
}

JsonReader JsonReader::object(const std::string& key) { return {document_, &need(key), at(key)}; }

std::optional<JsonReader> JsonReader::objectIfAny(const std::string& key) {
  if (!get(key)) return {};
  return object(key);
}

void JsonReader::array(const std::string& key, const std::function<void(JsonReader)>& each) {
  const json* value = get(key);
  if (!value) return;
  if (!value->is_array()) refuse(key, "a list [ … ]");
  for (std::size_t i = 0; i < value->size(); ++i)
    each(JsonReader(document_, &(*value)[i], at(key) + "/" + std::to_string(i)));
}

void JsonReader::members(const std::string& key, const std::function<void(const std::string&, JsonReader)>& each) {
  const json* value = get(key);
  if (!value) return;
  if (!value->is_object()) refuse(key, "an object { … }");
  for (const auto& [name, member] : value->items()) each(name, JsonReader(document_, &member, at(key) + "/" + name));
}

Values JsonReader::values(const std::string& key, std::span<const Parameter> declared) {
  Values values;
  auto reader = objectIfAny(key);
  if (!reader) return values;
  for (const Parameter& parameter : declared) {
    const json* value = reader->get(parameter.name);
    if (!value) continue;
    if (parameter.choices.empty()) {
      if (!value->is_number()) reader->refuse(parameter.name, "a number");
      values[parameter.name] = value->get<double>();
      check(parameter, values[parameter.name], reader->at(parameter.name));
    } else {
      const std::string word = reader->word(parameter.name, parameter.choices);
      const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), word);
      values[parameter.name] = static_cast<double>(found - parameter.choices.begin());
    }
  }
  reader->finish();
  return values;
}

Values JsonReader::anyValues(const std::string& key) {
  Values values;
  auto reader = objectIfAny(key);
  if (!reader) return values;
  for (const auto& [name, value] : reader->node().items()) {
    if (!value.is_number()) reader->refuse(name, "a number");
    values[name] = value.get<double>();
  }
  return values;
}

void JsonReader::finish() const {
  for (const auto& [name, value] : node_->items()) {
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    std::set<std::string> known(asked_.begin(), asked_.end());
    std::string names;
    for (const std::string& key : known) names += (names.empty() ? "" : ", ") + key;
    throw InputError(place_ + ": key \"" + shortened(name) + "\" is not known; known keys: " + names);
  }
}

json toJson(const Values& values, std::span<const Parameter> declared) {
  json object = json::object();
  for (const auto& [name, value] : values) {
    const Parameter* parameter = find(declared, name);
    const bool whole = value == std::floor(value) && std::abs(value) < wholeLimit;
    if (parameter && !parameter->choices.empty() && value >= 0 &&
        value < static_cast<double>(parameter->choices.size()))
      object[name] = parameter->choices[static_cast<std::size_t>(value)];
    else if (parameter && parameter->integer && whole)
      object[name] = static_cast<long long>(value);
    else
      object[name] = value;
  }
  return object;
}

}  // namespace btr
