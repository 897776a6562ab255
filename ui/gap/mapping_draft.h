#pragma once
#include <QString>
#include <QStringList>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace btr::ui {

/// One line of the mapping form, as it was typed.
struct MappingRow {
  QString channel, column;
  QString scale = "1", offset = "0";  ///< without the sign
  bool flipped = false;               ///< the sign is turned
  bool operator==(const MappingRow&) const = default;
};

/// A mapping while it is being edited: any text may stand in it. What the form does not show (settings, added columns,
/// "optional", "compare", "segments", "resample") stays as the file had it.
struct MappingDraft {
  std::vector<MappingRow> rows;
  bool countsTime = false;  ///< no column has the time ("period_s"); that stays as the file had it
  std::string base = "{}";  ///< the JSON that it was read from
  bool operator==(const MappingDraft&) const = default;

  /// Names that are channels already map to themselves; "t", "time", "timestamp" and their kin become time_s.
  static MappingDraft guess(const QStringList& columns);
  /// Throws InputError for what is not a mapping.
  static MappingDraft fromJson(const std::string& text, const std::string& place);
  /// Only of a draft without problems.
  std::string toJson() const;
};

enum class MappingField { channel, column, scale, offset };
/// What is wrong, by line and field; a line of −1 is about the whole. Empty: it can be saved.
using MappingProblems = std::map<std::pair<int, MappingField>, QString>;
MappingProblems problemsOf(const MappingDraft& draft, const QStringList& columns);

/// Units in which a file may give a channel, with the factor to the channel's own: "deg" → 0.0174533.
std::vector<std::pair<QString, double>> unitsFor(const QString& channel);
/// The factor of the unit that a column's heading says ("angle [°]", "t_ms", "pos / mm"), if it is one of the
/// channel's.
std::optional<double> unitInHeading(const QString& column, const QString& channel);

/// The first line of a CSV file as column names, and the smallest and largest number of each among its first rows.
struct CsvPreview {
  QStringList columns;
  std::vector<std::pair<double, double>> ranges;  ///< by column; NaN where no number stands
};
/// Throws InputError.
CsvPreview previewCsv(const QString& path);

}  // namespace btr::ui
