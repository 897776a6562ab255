#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace btr::cli {

/// The channels that a listener wants of every control period, kept until the next row is told.
class LiveSignals {
 public:
  /// From now on these, of a world with such `channels`; what it does not have is told as null. None: nothing is kept.
  void choose(std::vector<std::string> wanted, const std::vector<std::string>& channels);
  /// The world has other channels now.
  void resolve(const std::vector<std::string>& channels);
  bool wanted() const { return !wanted_.empty(); }
  const std::vector<std::string>& names() const { return wanted_; }
  /// After a control period; `row` has a number for each of the world's channels.
  void add(long period, const std::vector<double>& row);
  /// [[period, value, …], …] since the last call.
  nlohmann::json take();

 private:
  std::vector<std::string> wanted_;
  std::vector<int> columns_;  ///< by wanted channel, −1: there is none
  nlohmann::json samples_ = nlohmann::json::array();
};

}  // namespace btr::cli
