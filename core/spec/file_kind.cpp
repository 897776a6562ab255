#include "core/spec/file_kind.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "core/spec/error.h"

namespace btr {
namespace {

constexpr std::size_t enough_bytes = 64 * 1024;

std::string beginningOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(enough_bytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

std::string formatIn(const std::string& text) {
  static const std::regex format(R"re("format"\s*:\s*"(uchilsim-[a-z-]+-[0-9]+)")re");
  std::smatch found;
  return std::regex_search(text, found, format) ? found[1].str() : std::string();
}

/// Names in the first line, and a second line that begins with a number.
bool looksLikeTable(const std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return false;
  const bool columns = text.find_first_of(",;\t") < end;
  const std::size_t number = text.find_first_not_of(" \t\"+-", end + 1);
  return columns && number != std::string::npos && std::isdigit(static_cast<unsigned char>(text[number])) != 0;
}

FileKind kindOfFormat(const std::string& format) {
  if (format.starts_with("uchilsim-experiment-")) return FileKind::experiment;
  if (format.starts_with("uchilsim-scene-")) return FileKind::scene;
  if (format.starts_with("uchilsim-game-")) return FileKind::game;
  if (format.starts_with("uchilsim-simulator-")) return FileKind::simulator;
  if (format == "uchilsim-grid-1") return FileKind::grid;
  return FileKind::otherFormat;
}

std::string inWords(FileKind kind) {
  switch (kind) {
    case FileKind::missing:
      return "a file that is not there";
    case FileKind::folder:
      return "a folder";
    case FileKind::report:
      return "the folder of a gap report";
    case FileKind::database:
      return "an SQLite database";
    case FileKind::experiment:
      return "an experiment";
    case FileKind::game:
      return "a game";
    case FileKind::scene:
      return "a scene";
    case FileKind::simulator:
      return "a simulator";
    case FileKind::grid:
      return "a grid of experiments";
    case FileKind::mapping:
      return "a mapping of a recording's columns";
    case FileKind::otherFormat:
      return "another file of this program";
    case FileKind::json:
      return "a JSON file of another program";
    case FileKind::robot:
      return "a robot model";
    case FileKind::recording:
      return "a table (CSV)";
    case FileKind::text:
      return "a text file";
    case FileKind::binary:
      return "a binary file";
  }
  return {};
}

std::string expectedInWords(FileKind kind) {
  switch (kind) {
    case FileKind::experiment:
      return "an experiment (JSON with \"format\": \"uchilsim-experiment-1\")";
    case FileKind::game:
      return "a game (JSON with \"format\": \"uchilsim-game-1\")";
    case FileKind::scene:
      return "a scene (JSON with \"format\": \"uchilsim-scene-1\")";
    case FileKind::robot:
      return "a robot model (VRML97 or URDF)";
    case FileKind::recording:
      return "a recording (CSV)";
    default:
      return inWords(kind);
  }
}

}  // namespace

FileKind kindOfFile(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none))
    return std::filesystem::exists(std::filesystem::path(path) / "report.json", none) ? FileKind::report
                                                                                      : FileKind::folder;
  if (!std::filesystem::is_regular_file(path, none)) return FileKind::missing;
  const std::string text = beginningOf(path);
  if (text.starts_with("SQLite format 3")) return FileKind::database;
  if (text.find('\0') != std::string::npos) return FileKind::binary;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return FileKind::text;
  if (text.compare(first, 5, "#VRML") == 0) return FileKind::robot;
  if (text[first] == '<') return text.find("<robot") != std::string::npos ? FileKind::robot : FileKind::text;
  if (text[first] == '{') {
    if (const std::string format = formatIn(text); !format.empty()) return kindOfFormat(format);
    return path.ends_with(".mapping.json") ? FileKind::mapping : FileKind::json;
  }
  return looksLikeTable(text) ? FileKind::recording : FileKind::text;
}

std::string kindInWords(const std::string& path) {
  const FileKind kind = kindOfFile(path);
  if (kind == FileKind::otherFormat) return "a " + formatIn(beginningOf(path)) + " file";
  if (kind == FileKind::robot) {
    const bool urdf = beginningOf(path).find("<robot") != std::string::npos;
    return std::string("a robot model (") + (urdf ? "URDF" : "VRML97") + ")";
  }
  return inWords(kind);
}

void requireKind(const std::string& path, FileKind expected) {
  const FileKind kind = kindOfFile(path);
  if (kind == expected || kind == FileKind::missing || kind == FileKind::json) return;
  throw InputError(path + " is " + kindInWords(path) + "; expected: " + expectedInWords(expected));
}

}  // namespace btr
