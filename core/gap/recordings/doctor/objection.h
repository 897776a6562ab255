#pragma once
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/gap/recordings/doctor/doctor.h"

namespace btr {

/// What the doctor has against an analysis of several recordings: a finding that is certain and that no other recording
/// of the same mapping refutes.
class Objection {
 public:
  /// One more recording; `mapping` is the file that says how it was read, "" for none.
  void hear(const std::string& source, const std::string& mapping, const Diagnosis& found);
  /// "FILE: WORDS; and FILE: WORDS" of the first recording that shows it, for each channel; nothing if there is none.
  std::optional<std::string> text() const;

 private:
  using Read = std::pair<std::string, std::string>;  // mapping, channel
  struct Certain {
    Read read;
    bool refutable = false;
    std::string text;
  };
  std::vector<Certain> certain_;
  std::set<Read> following_;  // channels that follow their command in some recording
};

}  // namespace btr
