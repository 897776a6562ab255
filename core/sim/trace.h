#pragma once
#include <string>
#include <vector>

namespace btr {

/// What happened in a trial, sampled once a control period (and at the start): a table whose columns are named as in
/// recordings: "time_s", "ers7.base.x_m" … "ers7.base.qw", "ers7.LF_J1.position_rad", "ers7.LF_J1.command_rad",
/// "ers7.LF_J1.torque_nm", "ball.x_m", "ball.qw", "ers7.LF_LOWER.contact", "ers7.ACCEL.ax_m_s2" ….
struct Trace {
  std::vector<std::string> channels;
  std::vector<double> values;  ///< row by row, channels.size() numbers each

  std::size_t rows() const { return channels.empty() ? 0 : values.size() / channels.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * channels.size() + column]; }
  /// Column of that name, or −1.
  int column(const std::string& name) const;
  /// SHA-256 over names and the bits of all numbers, hexadecimal: equal means bit-identical.
  std::string sha256() const;
  /// Text as in a recording file.
  std::string toCsv() const;
  /// Lossless compressed bytes for the database, and back. Throws InputError if the bytes are damaged.
  std::string pack() const;
  static Trace unpack(const std::string& bytes);
};

}  // namespace btr
