#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace btr {

/// What a search could not simulate because the scene refuses the numbers (a mass below zero, an unstable gear):
/// counted by what was done and why, to be named in the report's notes.
class RefusedJobs {
 public:
  /// `what`: "fit".
  void add(const std::string& what, const std::string& why) {
    ++counts_[{what, why}];
    last_ = why;
  }
  const std::string& last() const { return last_; }
  /// "3 fits were left out: WHY", by what and why.
  std::vector<std::string> notes() const {
    std::vector<std::string> all;
    for (const auto& [key, count] : counts_)
      all.push_back(std::to_string(count) + " " + key.first + (count == 1 ? " was" : "s were") +
                    " left out, as the scene refuses the numbers: " + key.second);
    return all;
  }

 private:
  std::map<std::pair<std::string, std::string>, int> counts_;
  std::string last_;
};

}  // namespace btr
