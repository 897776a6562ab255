#include "core/gap/recordings/table/other_table.h"

#include <filesystem>
#include <limits>

#include "core/gap/recordings/channel_name.h"
#include "core/spec/error.h"

namespace btr {

void appendTable(Recording& trial, const Recording& other) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::string name = std::filesystem::path(other.source).filename().string();
  for (const Recording* table : {static_cast<const Recording*>(&trial), &other})
    if (table->places.stamps)
      throw InputError(table->source +
                       ": times that are dates or times of day begin with each file anew; tables that "
                       "are joined need times that are numbers of one clock");
  const std::size_t before = trial.rows(), behind = other.rows();
  for (std::vector<double>& column : trial.columns) column.resize(before + behind, nothing);
  for (std::size_t row = 0; row < behind; ++row) trial.columns[0][before + row] = other.columns[0][row];
  trial.places.line.resize(before + behind, 0);

  for (std::size_t column = 1; column < other.channels.size(); ++column) {
    const std::string& channel = other.channels[column];
    if (!parseChannel(channel)) continue;
    if (trial.column(channel) >= 0)
      throw InputError(other.atHeader(column), "channel \"" + channel + "\" again",
                       "each channel in one of the tables");
    trial.channels.push_back(channel);
    trial.columns.emplace_back(before, nothing);
    trial.columns.back().insert(trial.columns.back().end(), other.columns[column].begin(), other.columns[column].end());
    trial.places.column.push_back(0);
    trial.places.lastDigit.push_back(other.places.lastDigit[column]);
  }
  trial.notCompared.insert(trial.notCompared.end(), other.notCompared.begin(), other.notCompared.end());
  trial.notes.push_back("joined with " + name + ", SHA-256 " + other.sha256);
  for (const std::string& note : other.notes)
    if (note.find("not mapped to a channel") == std::string::npos) trial.notes.push_back(name + ": " + note);
}

}  // namespace btr
