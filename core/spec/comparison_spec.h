#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace btr {

/// Experiments that are run with the same seeds and compared ("format": "uchilsim-comparison-1").
struct ComparisonSpec {
  struct Arm {
    std::string name;        ///< for tables and charts
    std::string experiment;  ///< path of the experiment's file, relative to the comparison's
  };
  std::string name;
  std::vector<Arm> arms;             ///< the first is what the others are compared with
  std::vector<std::uint64_t> seeds;  ///< of the runs, each once
  std::string place, directory;      ///< the file and its folder; not part of the JSON
};

class JsonReader;
/// The list "seeds": at least one whole number from 0 to 2^53 − 1, each once. Throws InputError.
std::vector<std::uint64_t> seedsFrom(JsonReader& reader);

/// Throws InputError: at least one arm and one seed, names and seeds each once.
ComparisonSpec comparisonFromJson(const std::string& text, const std::string& place, const std::string& directory);
ComparisonSpec loadComparison(const std::string& path);

}  // namespace btr
