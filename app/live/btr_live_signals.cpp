#include "app/live/btr_live_signals.h"

#include <algorithm>
#include <utility>

namespace btr::cli {

void LiveSignals::choose(std::vector<std::string> wanted, const std::vector<std::string>& channels) {
  wanted_ = std::move(wanted);
  resolve(channels);
}

void LiveSignals::resolve(const std::vector<std::string>& channels) {
  columns_.clear();
  for (const std::string& name : wanted_) {
    const auto found = std::ranges::find(channels, name);
    columns_.push_back(found == channels.end() ? -1 : static_cast<int>(found - channels.begin()));
  }
}

void LiveSignals::add(long period, const std::vector<double>& row) {
  nlohmann::json sample = nlohmann::json::array({period});
  for (const int column : columns_) {
    if (column >= 0 && static_cast<std::size_t>(column) < row.size())
      sample.push_back(row[static_cast<std::size_t>(column)]);
    else
      sample.push_back(nullptr);
  }
  samples_.push_back(std::move(sample));
}

nlohmann::json LiveSignals::take() { return std::exchange(samples_, nlohmann::json::array()); }

}  // namespace btr::cli
