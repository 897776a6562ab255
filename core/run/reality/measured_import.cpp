#include "core/run/reality/measured_import.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/plugin/measured_table.h"
#include "core/spec/error.h"

namespace btr {
namespace {

void requireTask(const std::string& place, Id individual, const std::vector<MeasurementTask>& tasks) {
  if (std::any_of(tasks.begin(), tasks.end(), [&](const auto& t) { return t.individual == individual; })) return;
  std::string asked;
  for (const MeasurementTask& task : tasks) asked += (asked.empty() ? "" : ", ") + std::to_string(task.individual);
  throw InputError(place, "individual " + std::to_string(individual),
                   asked.empty() ? "this run asks for none" : "this run asks for " + asked);
}

}  // namespace

std::vector<MeasurementRecord> readMeasuredCsv(std::istream& stream, const std::string& place,
                                               const std::vector<MeasurementTask>* tasks, const std::string& unit,
                                               std::vector<std::string>* places) {
  MeasuredTable table(stream, place, unit, MeasuredTable::Of::individuals);
  std::vector<MeasurementRecord> all;
  for (MeasuredRow row; table.next(row);) {
    if (tasks) requireTask(table.atIndividual(), row.individual, *tasks);
    MeasurementRecord& m = all.emplace_back();
    m.individual = row.individual;
    m.isVoid = row.isVoid;
    m.value = row.value;
    m.note = row.note;
    if (places) places->push_back("line " + std::to_string(table.line()));
  }
  if (all.empty()) throw InputError(place + ": holds no values below its header");
  return all;
}

std::vector<MeasurementRecord> readMeasuredCsv(const std::string& path, const std::vector<MeasurementTask>* tasks,
                                               const std::string& unit, std::vector<std::string>* places) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw InputError(path + ": is a folder; a CSV file is needed");
  // Opening a pipe that nobody writes to would wait for ever.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path + ": is not a regular file; a CSV file is needed");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path + ": cannot be read (" + std::strerror(errno) + ")");
  return readMeasuredCsv(stream, path, tasks, unit, places);
}

}  // namespace btr
