#pragma once
#include <span>
#include <string>
#include <vector>

namespace btr::ui {

/// A quantity over time: a channel of the running world, or the speed of three of them.
struct Signal {
  std::string name;                   ///< ends in its unit, as a recording's columns do
  std::vector<std::string> channels;  ///< one: itself; x, y, z: the length of their change in a second
  bool operator==(const Signal&) const = default;
};

/// The signals that a world with such channels has: its channels, and the speed of whatever has x_m, y_m, z_m
/// ("ball.speed_m_s", a difference over one period).
std::vector<Signal> signalsOf(const std::vector<std::string>& channels);

/// The unit of a signal for people: "rad/s"; "" for none.
std::string unitOfSignal(const std::string& name);

/// The last seconds of some signals, every control period of them, beside the world's time. A plain value.
class SignalRecord {
 public:
  /// The record goes on: what is new is not known (NaN) of earlier times.
  void setSignals(std::vector<Signal> wanted);
  const std::vector<Signal>& all() const { return signals_; }
  /// What must be told of every control period: "time_s" first.
  std::vector<std::string> channels() const;
  /// Rows that are older than this before the newest one may be forgotten [s].
  void setSpan_s(double span) { span_s_ = span; }
  double span_s() const { return span_s_; }
  void clear();

  /// One control period; a number for each of `channels`. A period that is not after the newest one means that the
  /// world was put back: what came after it is forgotten.
  void add(long period, std::span<const std::string> channels, std::span<const double> values);

  std::size_t rows() const { return periods_.size() - first_; }
  long period(std::size_t row) const { return periods_[first_ + row]; }
  double time_s(std::size_t row) const { return times_[first_ + row]; }
  double value(std::size_t row, std::size_t signal) const { return columns_[signal][first_ + row]; }
  /// Control periods between the first and the last row that are not there.
  long missing() const;
  /// The row nearest to a time; rows() > 0.
  std::size_t rowAt(double time_s) const;
  /// A recording as gap analysis reads it: time_s and the signals; what is not known is an empty cell.
  std::string toCsv() const;

 private:
  double valueOf(const Signal& signal, std::span<const int> columns, std::span<const double> values, double time) const;
  void forgetFrom(long period);
  void forgetOld();

  std::vector<Signal> signals_;
  std::vector<long> periods_;
  std::vector<double> times_;
  std::vector<std::vector<double>> columns_;  ///< by signal
  std::size_t first_ = 0;                     ///< rows before it are forgotten
  std::vector<std::string> layout_;           ///< for which these were looked up …
  std::vector<std::vector<int>> sources_;     ///< … by signal: where its channels stand
  int timeColumn_ = -1;
  std::vector<std::vector<double>> last_;  ///< by signal: its channels in the row before
  double span_s_ = 60;
};

}  // namespace btr::ui
