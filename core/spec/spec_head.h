#pragma once
#include <string>

#include "core/spec/json_reader.h"

namespace btr {

/// How a file of the user's begins: "format" and "name". Checks the one and returns the other.
inline std::string nameOfSpec(JsonReader& reader, const char* format) {
  reader.word("format", {format});
  std::string name = reader.text("name");
  if (name.empty()) reader.refuse("name", "at least one letter");
  return name;
}

/// A text that may not be empty; `expected` says what it is.
inline std::string filledText(JsonReader& reader, const char* key, const char* expected) {
  std::string text = reader.text(key);
  if (text.empty()) reader.refuse(key, expected);
  return text;
}

}  // namespace btr
