#include "core/spec/system/output_path.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

fs::path resolved(const std::string& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path real = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : real;
}

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

void addTexts(const nlohmann::json& node, std::vector<std::string>& texts) {
  if (node.is_string()) texts.push_back(node.get<std::string>());
  if (node.is_structured())
    for (const nlohmann::json& element : node) addTexts(element, texts);
}

// Every text of a JSON file that could be a path; nothing of a file that is no JSON.
std::vector<std::string> textsOf(const std::string& path) {
  std::vector<std::string> texts;
  if (fs::path(path).extension() != ".json") return texts;
  try {
    addTexts(JsonReader::open(path).node(), texts);
  } catch (const InputError&) {
  }
  return texts;
}

void addWithNamed(const std::string& path, std::set<std::string>& found) {
  if (!isFile(path) || !found.insert(resolved(path).string()).second) return;
  for (const std::string& text : textsOf(path)) {
    if (text.empty() || text.size() > 4096 || text.find('\0') != std::string::npos) continue;
    addWithNamed((fs::path(path).parent_path() / text).string(), found);
  }
}

// The folder of a result has to be there and to take files.
void checkWritable(const fs::path& folder, const std::string& place) {
  std::error_code error;
  if (!fs::exists(folder, error)) throw InputError(place + ": cannot be made: there is no folder " + folder.string());
  if (!fs::is_directory(folder, error)) throw InputError(place + ": cannot be made: " + folder.string() + " is a file");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(place + ": cannot be made in " + folder.string() + " (" + std::strerror(errno) + ")");
}

void refuseInputs(const std::string& path, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (isSameFile(path, input))
      throw InputError(path +
                       ": is read by this command and would be replaced; choose another name for what it writes");
}

}  // namespace

std::vector<std::string> withNamedFiles(const std::vector<std::string>& files) {
  std::set<std::string> found;
  for (const std::string& file : files) addWithNamed(file, found);
  return {found.begin(), found.end()};
}

bool isSameFile(const std::string& one, const std::string& other) {
  std::error_code error;
  return fs::equivalent(one, other, error) || resolved(one) == resolved(other);
}

void checkOutputFile(const std::string& path, const std::vector<std::string>& inputs) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw InputError(path + ": is a folder; a file is to be written");
  refuseInputs(path, inputs);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  checkWritable(resolved(path).parent_path(), path);
  refuseDatabase(path);
}

void checkOutputFolder(const std::string& path, const std::vector<std::string>& names,
                       const std::vector<std::string>& inputs) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path))
    throw InputError(path + ": the folder cannot be made" + (error ? " (" + error.message() + ")" : ""));
  if (::access(path.c_str(), W_OK | X_OK) != 0)
    throw InputError(path + ": the folder cannot be written (" + std::strerror(errno) + ")");
  for (const std::string& name : names) refuseInputs((fs::path(path) / name).string(), inputs);
}

void checkNotBesideDatabase(const std::string& path, const std::string& database) {
  const std::string file = resolved(path).string(), base = resolved(database).string();
  static const std::regex kept(R"((-wal|-shm|-journal|\.(run|grid)-[0-9]+\.lock)?)");
  const bool beside = file.starts_with(base) && std::regex_match(file.substr(base.size()), kept);
  if (beside || isSameFile(path, database))
    throw InputError(path + ": belongs to the database " + database + "; choose another name for what is written");
}

}  // namespace btr
