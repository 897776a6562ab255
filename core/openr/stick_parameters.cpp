#include "core/openr/stick_parameters.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::openr {
namespace {

namespace fs = std::filesystem;

Parameter parameterFrom(JsonReader& reader) {
  constexpr double most = 1e12;
  Parameter parameter;
  parameter.name = reader.text("name");
  const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  if (parameter.name.empty() || !std::ranges::all_of(parameter.name, allowed))
    reader.refuse("name", "letters, digits and underscores");
  parameter.unit = reader.text("unit", "");
  parameter.meaning = reader.text("meaning", "");
  parameter.minimum = reader.number("min", -most, most);
  parameter.maximum = reader.number("max", -most, most);
  if (!(parameter.maximum > parameter.minimum)) reader.refuse("max", "more than min");
  parameter.byDefault = reader.number("default", parameter.minimum, parameter.maximum);
  parameter.integer = reader.flag("integer", false);
  reader.finish();
  return parameter;
}

const std::string shelfName = "uchilsim-sticks-", lockName = "owner";

/// A shelf whose lock nobody holds belongs to nobody.
void removeIfAbandoned(const fs::path& shelf) {
  struct stat status {};
  if (lstat(shelf.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid()) return;
  const int lock = open((shelf / lockName).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (lock < 0) return;
  std::error_code ignored;  // another process may be doing the same
  if (flock(lock, LOCK_EX | LOCK_NB) == 0) fs::remove_all(shelf, ignored);
  close(lock);
}

}  // namespace

std::vector<Parameter> stickParameters(const std::string& stick) {
  const std::string path = (fs::path(stick) / "parameters.json").string();
  JsonReader reader = JsonReader::parse(readFile(path), path);
  reader.word("format", {"uchilsim-openr-parameters-1"});
  std::vector<Parameter> all;
  reader.array("parameters", [&](JsonReader each) {
    all.push_back(parameterFrom(each));
    if (std::ranges::count(all, all.back().name, &Parameter::name) > 1) each.refuse("name", "each name once");
  });
  if (all.empty()) reader.refuse("parameters", "at least one");
  reader.finish();
  return all;
}

std::string parametersText(std::span<const Parameter> declared, std::span<const double> values) {
  std::string text;
  for (std::size_t i = 0; i < declared.size() && i < values.size(); ++i)
    text += declared[i].name + ' ' + toText(values[i]) + '\n';
  return text;
}

StickShelf::StickShelf() : owner_(getpid()) {
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  for (fs::directory_iterator at(temporary, error), end; !error && at != end; at.increment(error))
    if (at->path().filename().string().starts_with(shelfName)) removeIfAbandoned(at->path());
  std::string pattern = (temporary / (shelfName + "XXXXXX")).string();
  if (!mkdtemp(pattern.data())) {
    problem_ = pattern + ": " + std::strerror(errno);
    return;
  }
  folder_ = pattern;
  // It gets its name when it is locked: nobody finds it without an owner.
  const fs::path made = fs::path(folder_) / "making", name = fs::path(folder_) / lockName;
  lock_ = open(made.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0) fs::rename(made, name, error);
}

StickShelf::~StickShelf() {
  if (lock_ >= 0) close(lock_);
  if (getpid() != owner_ || folder_.empty()) return;
  std::error_code ignored;  // a temporary folder: nobody can do more about it
  fs::remove_all(folder_, ignored);
}

std::string StickShelf::newFolder() const {
  if (folder_.empty()) throw InputError("the system's folder for temporary files", problem_, "one that can be written");
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    const int process = std::atoi(at->path().filename().c_str());
    std::error_code ignored;
    if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) fs::remove_all(at->path(), ignored);
  }
  std::string pattern = (fs::path(folder_) / (std::to_string(getpid()) + "-XXXXXX")).string();
  if (!mkdtemp(pattern.data())) throw InputError(pattern, std::strerror(errno), "a folder for temporary files");
  return pattern;
}

PrivateStick::PrivateStick(const StickShelf& shelf, const std::string& stick, const std::string& parametersText)
    : folder_(shelf.newFolder()) {
  std::error_code problem;
  // Links stay links, which the program cannot follow out of its stick.
  fs::copy(stick, folder_, fs::copy_options::recursive | fs::copy_options::copy_symlinks, problem);
  if (problem) {
    std::error_code ignored;  // what is said is why it could not be copied
    fs::remove_all(folder_, ignored);
    throw InputError(stick, problem.message(), "a memory stick that can be copied to " + folder_);
  }
  writeFile((fs::path(folder_) / "PARAMS.TXT").string(), parametersText);
}

PrivateStick::~PrivateStick() {
  std::error_code ignored;  // a temporary folder: nobody can do more about it
  fs::remove_all(folder_, ignored);
}

}  // namespace btr::openr
