#include "ui/live/signal_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/gap/recordings/channel_name.h"
#include "core/spec/parameter.h"

namespace btr::ui {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

int columnIn(std::span<const std::string> channels, const std::string& name) {
  const auto found = std::ranges::find(channels, name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

}  // namespace

std::vector<Signal> signalsOf(const std::vector<std::string>& channels) {
  const std::set<std::string> there(channels.begin(), channels.end());
  std::vector<Signal> wanted;
  for (const std::string& channel : channels) {
    if (channel == "time_s") continue;
    wanted.push_back({channel, {channel}});
    if (!channel.ends_with(".z_m")) continue;
    const std::string of = channel.substr(0, channel.size() - 3);
    if (there.contains(of + "x_m") && there.contains(of + "y_m"))
      wanted.push_back({of + "speed_m_s", {of + "x_m", of + "y_m", channel}});
  }
  return wanted;
}

std::string unitOfSignal(const std::string& name) {
  if (name.ends_with("_rad_s2")) return "rad/s²";
  return name.ends_with("_m_s2") ? "m/s²" : unitOfChannel(name);
}

void SignalRecord::setSignals(std::vector<Signal> wanted) {
  std::vector<std::vector<double>> columns, last;
  for (const Signal& signal : wanted) {
    const auto before = std::ranges::find(signals_, signal);
    const auto index = static_cast<std::size_t>(before - signals_.begin());
    columns.push_back(before == signals_.end() ? std::vector<double>(periods_.size(), notKnown) : columns_[index]);
    last.push_back(before == signals_.end() ? std::vector<double>{} : last_[index]);
  }
  signals_ = std::move(wanted);
  columns_ = std::move(columns);
  last_ = std::move(last);
  layout_.clear();
}

std::vector<std::string> SignalRecord::channels() const {
  if (signals_.empty()) return {};
  std::vector<std::string> all{"time_s"};
  for (const Signal& signal : signals_)
    for (const std::string& channel : signal.channels)
      if (columnIn(all, channel) < 0) all.push_back(channel);
  return all;
}

void SignalRecord::clear() {
  periods_.clear();
  times_.clear();
  for (auto& column : columns_) column.clear();
  for (auto& values : last_) values.clear();
  first_ = 0;
}

void SignalRecord::add(long period, std::span<const std::string> channels, std::span<const double> values) {
  if (layout_.empty() || !std::ranges::equal(layout_, channels)) {
    layout_.assign(channels.begin(), channels.end());
    timeColumn_ = columnIn(channels, "time_s");
    sources_.clear();
    for (const Signal& signal : signals_) {
      sources_.emplace_back();
      for (const std::string& channel : signal.channels) sources_.back().push_back(columnIn(channels, channel));
    }
  }
  if (timeColumn_ < 0) return;
  const double time = values[static_cast<std::size_t>(timeColumn_)];
  if (!periods_.empty() && (period <= periods_.back() || !(time > times_.back()))) forgetFrom(period);
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    columns_[i].push_back(valueOf(signals_[i], sources_[i], values, time));
    last_[i].clear();
    for (const int source : sources_[i])
      last_[i].push_back(source < 0 ? notKnown : values[static_cast<std::size_t>(source)]);
  }
  periods_.push_back(period);
  times_.push_back(time);
  forgetOld();
}

double SignalRecord::valueOf(const Signal& signal, std::span<const int> columns, std::span<const double> values,
                             double time) const {
  if (std::ranges::any_of(columns, [](int column) { return column < 0; })) return notKnown;
  if (columns.size() == 1) return values[static_cast<std::size_t>(columns[0])];
  const std::vector<double>& before = last_[static_cast<std::size_t>(&signal - signals_.data())];
  if (before.size() != columns.size() || times_.empty()) return notKnown;
  double square = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double way = values[static_cast<std::size_t>(columns[k])] - before[k];
    square += way * way;
  }
  return std::sqrt(square) / (time - times_.back());
}

void SignalRecord::forgetFrom(long period) {
  const auto from = std::lower_bound(periods_.begin() + static_cast<std::ptrdiff_t>(first_), periods_.end(), period);
  const auto kept = static_cast<std::size_t>(from - periods_.begin());
  periods_.resize(kept);
  times_.resize(kept);
  for (auto& column : columns_) column.resize(kept);
  for (auto& values : last_) values.clear();
}

// The front is cut off in large pieces, so that a row costs the same however much is kept.
void SignalRecord::forgetOld() {
  while (first_ < times_.size() && times_[first_] < times_.back() - span_s_) ++first_;
  constexpr std::size_t piece = 4096;
  if (first_ < piece || first_ < times_.size() / 2) return;
  const auto count = static_cast<std::ptrdiff_t>(first_);
  periods_.erase(periods_.begin(), periods_.begin() + count);
  times_.erase(times_.begin(), times_.begin() + count);
  for (auto& column : columns_) column.erase(column.begin(), column.begin() + count);
  first_ = 0;
}

long SignalRecord::missing() const {
  if (rows() == 0) return 0;
  return periods_.back() - periods_[first_] + 1 - static_cast<long>(rows());
}

std::size_t SignalRecord::rowAt(double time_s) const {
  const auto begin = times_.begin() + static_cast<std::ptrdiff_t>(first_);
  auto found = std::lower_bound(begin, times_.end(), time_s);
  if (found == times_.end()) --found;
  if (found != begin && time_s - *(found - 1) < *found - time_s) --found;
  return static_cast<std::size_t>(found - begin);
}

std::string SignalRecord::toCsv() const {
  std::string text = "time_s";
  for (const Signal& signal : signals_) text += "," + signal.name;
  text += '\n';
  for (std::size_t row = 0; row < rows(); ++row) {
    text += toText(time_s(row));
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      text += ',';
      if (std::isfinite(value(row, i))) text += toText(value(row, i));
    }
    text += '\n';
  }
  return text;
}

}  // namespace btr::ui
