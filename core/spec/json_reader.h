#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// Reads a JSON object key by key and remembers where it is, so that each error names file, key, value and what is
/// allowed. After the last key call finish(): keys that nobody asked for are an error (a typo must not become a
/// default).
class JsonReader {
 public:
  /// Parses text; `place` (usually the file name) begins each message. Throws InputError with line and column.
  static JsonReader parse(const std::string& text, const std::string& place);
  /// Reads and parses a file of at most 64 MiB.
  static JsonReader open(const std::string& path);
  JsonReader(std::shared_ptr<const nlohmann::json> document, const nlohmann::json* node, std::string place);

  const std::string& place() const { return place_; }
  /// The place of a key, for messages: "kick.json /learner/settings".
  std::string at(const std::string& key) const;
  const nlohmann::json& node() const { return *node_; }
  bool has(const std::string& key) const;

  double number(const std::string& key, double minimum, double maximum);
  double number(const std::string& key, double minimum, double maximum, double byDefault);
  /// A finite number, or `unknown` where the file says null.
  double numberOrNull(const std::string& key, double unknown);
  long long integer(const std::string& key, long long minimum, long long maximum);
  long long integer(const std::string& key, long long minimum, long long maximum, long long byDefault);
  /// Any 64-bit number without sign.
  std::uint64_t seed(const std::string& key, std::uint64_t byDefault);
  bool flag(const std::string& key, bool byDefault);
  std::string text(const std::string& key);
  std::string text(const std::string& key, const std::string& byDefault);
  /// One of `words`; the first is not a default.
  std::string word(const std::string& key, const std::vector<std::string>& words);
  std::string word(const std::string& key, const std::vector<std::string>& words, const std::string& byDefault);
  /// Exactly `count` finite numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count);
  std::vector<double> numbers(const std::string& key, std::size_t count, const std::vector<double>& byDefault);
  /// Any count of finite numbers; null is NaN. Absent means none.
  std::vector<double> numberList(const std::string& key);
  std::vector<std::string> texts(const std::string& key);

  /// The value as it is, nullptr if absent; the key counts as asked for.
  const nlohmann::json* any(const std::string& key) { return get(key); }

  JsonReader object(const std::string& key);  ///< must exist
  std::optional<JsonReader> objectIfAny(const std::string& key);
  /// Calls `each` with a reader for every element (an object) of the array; absent means none.
  void array(const std::string& key, const std::function<void(JsonReader)>& each);
  /// Calls `each(name, reader)` for every member (an object) of the object `key`; absent means none.
  void members(const std::string& key, const std::function<void(const std::string&, JsonReader)>& each);
  /// A map from names to numbers, checked against the declared parameters (choices are written as words).
  Values values(const std::string& key, std::span<const Parameter> declared);
  /// A map from names to finite numbers, any names.
  Values anyValues(const std::string& key);

  /// Throws InputError if the object has a key that was never asked for.
  void finish() const;
  /// Throws InputError "PLACE KEY: value is not allowed; allowed".
  [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const;

 private:
  const nlohmann::json* get(const std::string& key);
  const nlohmann::json& need(const std::string& key);

  std::shared_ptr<const nlohmann::json> document_;
  const nlohmann::json* node_;
  std::string place_;
  std::vector<std::string> asked_;
};

/// The whole content of a regular file. Throws InputError if it cannot be read or is larger than `limit` bytes.
std::string readFile(const std::string& path, std::size_t limit = 64u << 20);
/// Replaces the file at once (temporary file, fsync, rename): a reader sees the old or the new content, never a part. A
/// link keeps pointing to its target. Throws InputError if it cannot be written or is a database.
void writeFile(const std::string& path, const std::string& content);

/// Throws InputError if the file begins as databases of SQLite do.
void refuseDatabase(const std::string& path);

/// Values as JSON, choices as words.
nlohmann::json toJson(const Values& values, std::span<const Parameter> declared);

}  // namespace btr
