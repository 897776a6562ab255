#pragma once
#include <stdexcept>
#include <string>

namespace btr {

/// An error for people: where it is (file, line, key), which value was found, what is allowed.
/// Programs print what() as one line and end with exit code 1.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// "PLACE: VALUE is not allowed; ALLOWED", for example "kick.json /learner/settings/population: 1 is not allowed; 2
  /// to 10000".
  InputError(const std::string& place, const std::string& value, const std::string& allowed)
      : std::runtime_error(place + ": " + value + " is not allowed; " + allowed) {}
  /// "FILE:LINE: MESSAGE".
  InputError(const std::string& file, int line, const std::string& message)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + message) {}
};

/// A step that could not be stored: the disk is full, or somebody keeps the database locked. What was stored before is
/// sound, and the work goes on from there when it is asked to.
class NotStored : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace btr
