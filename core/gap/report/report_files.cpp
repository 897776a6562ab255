// The report as a folder: report.json, the tables beside it, the page for people.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "core/gap/replay/number_table.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_html.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_read.h"
#include "core/gap/report/report_text.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

NumberTable overlayTable(const GapReport::Trial& trial) {
  NumberTable table{{"time_s"}, {trial.time_s}};
  for (const GapReport::Series& series : trial.series)
    for (const CurveName& curve : curveNames) {
      table.header.push_back(series.channel + ":" + curve.name);
      table.columns.push_back(series.*curve.values);
    }
  return table;
}

/// The tables that a report which is in the folder already has, by its own word; none if it cannot be read.
std::set<fs::path> overlaysOf(const fs::path& folder) {
  const std::string place = (folder / "report.json").string();
  std::vector<std::string> names;
  std::error_code failure;
  if (!fs::is_regular_file(place, failure)) return {};
  try {
    reportFromJson(readFile(place), place, names);
  } catch (const InputError&) {
    return {};
  }
  std::set<fs::path> files;
  for (const std::string& name : names) files.insert(folder / name);
  return files;
}

void makeFolder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!fs::is_directory(folder, failure)) throw InputError(folder.string() + ": the folder cannot be made");
}

}  // namespace

std::string overlayCsv(const GapReport::Trial& trial) { return toCsv(overlayTable(trial)); }

void readOverlayCsv(const std::string& path, GapReport::Trial& trial) {
  NumberTable table = readNumberTable(path);
  const std::vector<std::string> expected = overlayTable(trial).header;
  if (table.header != expected)
    throw InputError(path + " line 1: the columns are not those that report.json names for this trial; " +
                     (expected.size() > 1 ? "time_s, " + expected[1] + ", …" : std::string("time_s")));
  trial.time_s = std::move(table.columns[0]);
  std::size_t column = 1;
  for (GapReport::Series& series : trial.series)
    for (const CurveName& curve : curveNames) series.*curve.values = std::move(table.columns[column++]);
}

void writeReport(const GapReport& report, const std::string& folder) {
  const fs::path out(folder);
  makeFolder(out);
  makeFolder(out / "overlay");
  std::set<fs::path> stale = overlaysOf(out);
  for (std::size_t i = 0; i < report.trials.size(); ++i) {
    const fs::path file = out / "overlay" / overlayFileName(report, i);
    writeFile(file.string(), overlayCsv(report.trials[i]));
    stale.erase(file);
  }
  if (report.next.columns.empty())
    stale.insert(out / "next_command.csv");
  else
    writeFile((out / "next_command.csv").string(), toCsv(NumberTable{report.next.channels, report.next.columns}));
  if (report.remainder.on.empty())
    stale.insert(out / "remainder.csv");
  else
    writeFile((out / "remainder.csv").string(),
              toCsv(NumberTable{{report.remainder.on, "force", "standard_error"},
                                {report.remainder.x, report.remainder.y, report.remainder.standardError}}));
  writeFile((out / "simulator.json").string(), toJsonText(report.after));
  writeFile((out / "report.html").string(), toHtml(report));
  // Last: a folder with a report.json is whole.
  writeFile((out / "report.json").string(), toJsonText(report));
  std::error_code failure;  // what cannot be removed does no harm beside a whole report
  for (const fs::path& file : stale) fs::remove(file, failure);
}

GapReport loadReport(const std::string& folder) {
  const fs::path from(folder);
  std::error_code failure;
  if (!fs::is_directory(from, failure)) throw InputError(folder + ": there is no such folder");
  const std::string place = (from / "report.json").string();
  std::vector<std::string> overlays;
  GapReport report = reportFromJson(readFile(place), place, overlays);
  for (std::size_t i = 0; i < report.trials.size(); ++i)
    readOverlayCsv((from / overlays[i]).string(), report.trials[i]);
  if (!report.next.columns.empty()) {
    NumberTable table = readNumberTable((from / "next_command.csv").string());
    report.next.channels = std::move(table.header);
    report.next.columns = std::move(table.columns);
  }
  return report;
}

}  // namespace btr
