#pragma once
#include <string>
#include <vector>

namespace btr {

/// A recorded trial: named columns over time. `channels[0]` is "time_s".
struct Recording {
  std::string source;                 ///< file name, for messages
  std::string sha256;                 ///< of the file's bytes
  std::vector<std::string> channels;  ///< contract names; unmapped columns keep their own names
  std::vector<std::vector<double>> columns;  ///< by channel, each rows() long; NaN where a cell is empty
  std::vector<std::string> notes;     ///< what was skipped or looks odd

  std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
  int column(const std::string& name) const;  ///< or −1
};

/// How one column of a foreign file becomes a channel: value = scale·(sign of scale included)·x + offset.
struct MappedColumn {
  std::string channel;
  std::string column;
  double scale = 1;
  double offset = 0;
};
struct Mapping {
  std::vector<MappedColumn> columns;
};
/// "NAME.mapping.json": {"time_s": {"column": "t", "scale": 0.001}, …}. Throws InputError.
Mapping loadMapping(const std::string& path);

/// Reads a CSV. With no mapping given, `PATH.mapping.json`, then `mapping.json` in the same folder is used if it is there,
/// else the columns must have contract names. Damaged, empty, unordered, non-numeric files throw InputError with line and
/// column; files larger than `limit` bytes are refused.
Recording loadRecording(const std::string& path, const Mapping* mapping = nullptr, std::size_t limit = 1u << 30);

}  // namespace btr
