#include "core/openr/stick_config.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/openr/file_text.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

namespace fs = std::filesystem;

/// The entry of `folder` named `name`: as it is written, else upper-cased, else in any other case; else upper-cased
/// though it is not there.
std::string entryOf(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::symlink_status(folder / name, error).type() != fs::file_type::not_found) return name;
  const std::string wanted = upper(name);
  if (fs::symlink_status(folder / wanted, error).type() != fs::file_type::not_found) return wanted;
  std::string found;
  for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error)) {
    const std::string other = each->path().filename().string();
    if (upper(other) == wanted && (found.empty() || other < found)) found = other;
  }
  return found.empty() ? wanted : found;
}

/// The link at `path` may stay if what it points to is within `root`.
bool leadsOutside(const fs::path& path, const fs::path& root) {
  std::error_code error;
  if (fs::symlink_status(path, error).type() != fs::file_type::symlink) return false;
  const fs::path target = fs::weakly_canonical(path, error);
  if (error) return true;
  const auto [at, unused] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
  return at != root.end();
}

std::vector<std::vector<std::string>> linesOf(const std::string& stick, const std::string& name,
                                              const std::string& design, std::size_t words) {
  const std::string path = onStick(stick, "/MS/OPEN-R/MW/CONF/" + name);
  if (path.empty()) throw InputError(stick + "/OPEN-R/MW/CONF/" + name + " leads out of the stick's folder");
  auto lines = configLines(content(path), design);
  for (const auto& line : lines)
    if (line.size() < words)
      throw InputError(path, "\"" + line[0] + "\" alone", std::to_string(words) + " words a line are");
  return lines;
}

}  // namespace

std::vector<std::vector<std::string>> configLines(const std::string& text, const std::string& design) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream in(text);
  std::string line;
  bool holds = true;
  while (std::getline(in, line)) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<std::string> found;
    for (std::string word; words >> word;) found.push_back(word);
    if (found.empty()) continue;
    if (found[0].front() == '[')
      holds = upper(found[0]) == "[" + upper(design) + "]";
    else if (holds)
      lines.push_back(found);
  }
  return lines;
}

StickConfig stickConfig(const std::string& stick, const std::string& design) {
  const std::string objects = onStick(stick, "/MS/OPEN-R/MW/CONF/OBJECT.CFG");
  std::error_code error;
  if (objects.empty() || !fs::is_regular_file(objects, error))
    throw InputError(stick +
                     ": OPEN-R/MW/CONF/OBJECT.CFG is missing; it lists the objects of the program, as `btr openr "
                     "build` writes it");
  StickConfig config;
  for (const auto& line : linesOf(stick, "OBJECT.CFG", design, 1)) config.objects.push_back(line[0]);
  const std::string connections = onStick(stick, "/MS/OPEN-R/MW/CONF/CONNECT.CFG");
  config.connected = !connections.empty() && fs::exists(connections, error);
  for (const auto& line : linesOf(stick, "CONNECT.CFG", design, 2)) config.connections.emplace_back(line[0], line[1]);
  for (const auto& line : linesOf(stick, "DESIGNDB.CFG", design, 2)) config.designData[line[0]] = line[1];
  return config;
}

std::string onStick(const std::string& stick, const std::string& path) {
  if (path.size() < 3 || upper(path.substr(0, 3)) != "/MS" || (path.size() > 3 && path[3] != '/')) return "";
  if (path.find('\0') != std::string::npos) return "";
  std::error_code error;
  const fs::path root = fs::canonical(stick, error);
  if (error) return "";
  fs::path at = root;
  std::istringstream parts(path.substr(3));
  for (std::string part; std::getline(parts, part, '/');) {
    if (part.empty() || part == ".") continue;
    if (part == "..") return "";
    at /= entryOf(at, part);
    if (leadsOutside(at, root)) return "";
  }
  return at.string();
}

}  // namespace btr::openr
