#include "core/run/reality/stored_recordings.h"

#include <filesystem>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace fs = std::filesystem;

CheckedRecording checkRecording(const std::string& path, const std::string& mapping, const std::string& scene) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  std::string mappingPath = mapping;
  if (mappingPath.empty()) mappingPath = findMapping(path, scene).value_or("");
  CheckedRecording checked;
  RecordingRecord& record = checked.record;
  if (!mappingPath.empty()) record.mappingJson = readFile(mappingPath);
  const std::optional<Mapping> map =
      mappingPath.empty() ? std::nullopt : std::optional(mappingFromJson(record.mappingJson, mappingPath));

  if (map && !map->tables.empty())
    throw InputError(mappingPath + ": \"tables\" joins several files, of which a run keeps one; join them in one file");
  StoredRecording& stored = checked.stored;
  std::string hash;
  for (const Recording& trial : loadTrials(path, map ? &*map : nullptr)) {
    ++stored.trials;
    stored.rows += trial.rows();
    for (const std::string& note : trial.notes) stored.notes.push_back(note);
    hash = trial.sha256;
  }
  record.name = fs::path(path).filename().string();
  record.csv = readFile(path, largest);
  record.sha256 = sha256(record.csv);
  // Trials carry the hash of their file: what is stored is what was checked.
  if (!hash.empty() && hash != record.sha256) throw InputError(path + ": the file was changed while it was read");
  record.source = fs::absolute(path).lexically_normal().string();
  return checked;
}

StoredRecording keepRecording(Database& database, Id experiment, CheckedRecording checked, Id individual) {
  auto& [record, stored] = checked;
  record.experiment = experiment;
  record.individual = individual;
  for (const RecordingRecord& other : database.recordings(experiment))
    if (other.sha256 == record.sha256 && other.mappingJson == record.mappingJson && other.individual == individual) {
      stored.id = other.id;
      return stored;
    }
  stored.id = database.addRecording(record);
  stored.isNew = true;
  return stored;
}

StoredRecording importRecording(Database& database, Id experiment, const std::string& path, const std::string& mapping,
                                Id individual, const std::string& scene) {
  return keepRecording(database, experiment, checkRecording(path, mapping, scene), individual);
}

std::string exportRecording(const Database& database, Id recording, const std::string& folder) {
  return writeRecordingFiles(database.recording(recording), folder);
}

std::string writeRecordingFiles(const RecordingRecord& record, const std::string& folder) {
  const fs::path out(folder);
  std::error_code failure;
  fs::create_directories(out, failure);
  if (!fs::is_directory(out, failure)) throw InputError(folder + ": the folder cannot be made");
  // The stored name is text from a file: it stays within the folder.
  const std::string name = fs::path(record.name).filename().string();
  if (name.empty() || name == "." || name == "..")
    throw InputError("recording " + std::to_string(record.id), "the name \"" + record.name + "\"", "a file's name");
  const auto write = [&](const fs::path& path, const std::string& content) {
    if (fs::exists(path, failure) && readFile(path.string(), std::size_t{1} << 30) != content)
      throw InputError(path.string() + ": is there already with other content; choose another folder");
    writeFile(path.string(), content);
  };
  write(out / name, record.csv);
  if (!record.mappingJson.empty()) write(out / (fs::path(name).stem().string() + ".mapping.json"), record.mappingJson);
  return (out / name).string();
}

}  // namespace btr
