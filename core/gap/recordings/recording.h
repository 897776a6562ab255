#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/mapping.h"
#include "core/spec/parameter.h"

namespace btr {

/// Where the numbers of a recording stand in its file, for messages; empty for a recording that no file holds.
struct FilePlaces {
  std::string file;
  std::size_t headerLine = 0;
  std::vector<std::size_t> column;  ///< by channel, from 1; 0: a time that is counted
  std::vector<std::uint32_t> line;  ///< by row; empty once rows were resampled
  std::vector<double> lastDigit;  ///< by channel: what the last decimal written is worth [the channel's unit]; 0: none
  bool stamps = false;            ///< time was written as date or time of day
};

/// A recorded trial: named columns over time. `channels[0]` is "time_s", strictly increasing.
struct Recording {
  std::string source;                        ///< path, for messages
  std::string sha256;                        ///< of the file's bytes
  std::string mapping;                       ///< file that says how it was read, "" for none
  std::vector<std::string> channels;         ///< contract names; unmapped columns keep their own names
  std::vector<std::vector<double>> columns;  ///< by channel, each rows() long; NaN where a cell is empty
  Values settings;                           ///< scene numbers that held in this trial, by path (see Mapping)
  std::vector<std::string> thinned;          ///< channels of which repeated readings were emptied (see repeated.h)
  std::vector<std::string> notCompared;      ///< channels that give the start but are not compared (see MappedColumn)
  std::vector<double> filteredNoise;  ///< by channel: what a filter left of its noise, where it hides it; 0: none
  std::vector<std::string> notes;     ///< what was skipped or looks odd
  bool beginsAtRest = false;          ///< known beforehand: nothing moves at its first row
  bool bounded = false;               ///< its mapping says where it begins or ends
  /// What inputs do between two rows that they go on through (between_rows.h), as the share of the way to the next row
  /// that they are ahead on average: 0 they hold, ½ they go on in a straight line; nothing: they hold, and an analysis
  /// may find otherwise.
  std::optional<double> betweenRows;
  bool lostRowsHold = false;  ///< the mapping says that nothing came while rows were lost
  FilePlaces places;
  double filterPeriod_s = 0, filterCutoff_hz = 0;  ///< the rhythm that a low-pass filter worked at, and its cutoff; 0:
                                                   ///< none (see resampled())

  std::size_t rows() const { return columns.empty() ? 0 : columns[0].size(); }
  double samplePeriod() const;                ///< mean [s]; of at least two rows
  int column(const std::string& name) const;  ///< or −1
  /// "FILE line 3, column 2 (CHANNEL)" as far as it is known; `row` 0 is the first one.
  std::string at(std::size_t column, std::size_t row) const;
  std::string atHeader(std::size_t column) const;
};

/// Reads a table (see TableReader) in one pass; memory is that of the numbers. With no mapping given, findMapping() is
/// asked, else the columns must have contract names. Damaged, empty, unordered, non-numeric files, numbers that no
/// robot has and clocks that jump throw InputError with line and column; files larger than `limit` bytes are refused
/// before they are read. Rows of several topics are joined, counters that wrap are followed, readings that only repeat
/// the one before are emptied; notes say so. Columns that nobody maps are kept with a note. A file that its mapping
/// divides into trials is refused here.
Recording loadRecording(const std::string& path, const Mapping* mapping = nullptr, std::size_t limit = 1u << 30);

/// The file's trials, in their order: one, or those that its mapping divides it into, then called "DIR/NAME-1.csv" …
std::vector<Recording> loadTrials(const std::string& path, const Mapping* mapping = nullptr,
                                  std::size_t limit = 1u << 30);
/// The same with the mapping file that was asked for ("" for none), else the one that findMapping() finds, else none.
std::vector<Recording> loadTrialsFor(const std::string& path, const std::string& mapping, const std::string& scene);

}  // namespace btr
