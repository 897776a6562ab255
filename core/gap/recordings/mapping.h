#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// How columns of a foreign file become a channel: value = scale·x + offset + Σ scaleᵢ·xᵢ; a negative scale turns the
/// sign.
struct MappedColumn {
  struct Added {
    std::string column;
    double scale = 1;
    bool optional = false;
  };
  std::string channel;
  std::string column;  ///< its name, or numberedColumn()
  double scale = 1;
  double offset = 0;
  bool optional = false;          ///< a file without this column is accepted
  std::optional<double> wrap;     ///< period after which its counter begins again [the file's unit], 0: it never does;
                                  ///< nothing: found out
  std::optional<int> signBit;     ///< bit of a whole number that is its sign, -1: none; nothing: found out
  std::optional<double> missing;  ///< the file's number for "no value", NaN: it has none; nothing: found out
  bool compare = true;            ///< false: a measurement that gives the start and the motion but is not compared
  std::vector<Added> added;       ///< the other terms, e.g. a relative angle from two absolute ones
};
/// Numbers of the scene that were set differently from trial to trial and stand only in the file's name.
struct TrialSetting {
  std::string fileContains;
  Values values;  ///< by path into the scene, e.g. "robots.leg.servos.knee.p"
};
struct OtherTable;
struct Mapping {
  std::string source;
  std::vector<MappedColumn> columns;
  double rowPeriod_s = 0;          ///< seconds from row to row where no column has the time; 0: a column has it
  std::vector<OtherTable> tables;  ///< of the same trial, joined with this one
  std::vector<TrialSetting> settings;
  std::optional<double> retime_s;         ///< rows are even samples of this period, 0: of the one that the stamps show
  double period_s = 0, lowpass_hz = 0;    ///< see Resampling; both 0: the samples as they are
  std::string segmentColumn;              ///< whenever its number changes a new trial begins; "": the file is one trial
  std::optional<double> from_s, until_s;  ///< rows of each trial that count, seconds after its first one
  bool lostRowsHold = false;              ///< inputs hold where rows are missing (see fillLostRows())
  std::optional<double> betweenRows;      ///< see Recording
};

/// Another file of the trial, beside it: fixed by name, or by what its name has in another's place.
struct OtherTable {
  std::string file;  ///< "" where `replace` and `with` make it from the recording's name
  std::string replace, with;
  Mapping mapping;  ///< columns and rowPeriod_s alone
  /// Of the recording at `path`. Throws InputError where the recording's name has no `replace`.
  std::string pathBeside(const std::string& path) const;
};

/// {"time_s": {"column": "t", "scale": 0.001}, …, "settings": [{"file_contains": "kp100", "values": {…}}],
/// "segments": {"column": "piece"}, "retime": "even", "lost_rows": "hold", "between_rows": "line",
/// "resample": {"period_s": 0.01, "lowpass_hz": 20}}. Throws InputError for what is not a channel, a channel or a key
/// that nobody knows.
Mapping mappingFromJson(const std::string& text, const std::string& place);
Mapping loadMapping(const std::string& path);
/// Beside "DIR/NAME.csv": "DIR/NAME.mapping.json", "DIR/NAME.csv.mapping.json" or "DIR/mapping.json", the first that is
/// there; else "SCENE.mapping.json" beside the scene ("" for none), which is for all recordings without one of their
/// own.
std::optional<std::string> findMapping(const std::string& recordingPath, const std::string& scene = "");

}  // namespace btr
