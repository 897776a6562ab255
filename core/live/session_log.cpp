#include "core/live/session_log.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/spec/error.h"
#include "core/spec/file_kind.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

/// Its first line. A game of another hash than the line says was changed by somebody.
void readHead(JsonReader& reader, SessionLog& log) {
  reader.word("format", {"uchilsim-log-1"});
  reader.text("version");
  log.gameSha256 = reader.text("game_sha256");
  if (const nlohmann::json* game = reader.any("game")) {
    log.game = gameFromJson(game->dump(), reader.at("game"), reader.text("directory"));
    if (gameSha256(*log.game) != log.gameSha256)
      reader.refuse("game_sha256", "the hash of its game, " + gameSha256(*log.game));
  }
  reader.finish();
}

std::string folderOf(const Game& game) {
  return (std::filesystem::current_path() / game.scene.directory).lexically_normal().string();
}

}  // namespace

std::string gameSha256(const Game& game) {
  Game plain = game;
  plain.view.clear();  // how it is looked at changes nothing
  return sha256(toJsonText(plain));
}

SessionLogWriter::SessionLogWriter(const std::string& path, const Game& game)
    : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_) throw InputError(path, std::strerror(errno), "a file that can be written");
  write(nlohmann::json{{"format", "uchilsim-log-1"},
                       {"version", UCHILSIM_VERSION},
                       {"game_sha256", gameSha256(game)},
                       {"game", nlohmann::json::parse(toJsonText(game))},
                       {"directory", folderOf(game)}}
            .dump());
}

SessionLogWriter::~SessionLogWriter() { std::fclose(file_); }

void SessionLogWriter::write(const std::string& line) {
  if (std::fprintf(file_, "%s\n", line.c_str()) < 0 || std::fflush(file_) != 0)
    throw InputError(path_, std::strerror(errno), "room for the session's log");
}

void SessionLogWriter::act(long period, const Act& act) {
  nlohmann::json line = toJson(act);
  line["period"] = period;
  write(line.dump());
}

void SessionLogWriter::mark(long period, const std::string& mark) {
  write(nlohmann::json{{"mark", mark}, {"period", period}}.dump());
}

long SessionLogWriter::place() const { return std::ftell(file_); }

void SessionLogWriter::returnTo(long place) {
  if (std::fflush(file_) != 0 || ftruncate(fileno(file_), place) != 0 || std::fseek(file_, place, SEEK_SET) != 0)
    throw InputError(path_, std::strerror(errno), "a session's log that can be shortened");
}

void SessionLogWriter::end(long period, const std::string& traceSha256) {
  write(nlohmann::json{{"end", true}, {"period", period}, {"trace_sha256", traceSha256}}.dump());
}

SessionLog loadSessionLog(const std::string& path) {
  const std::string text = readFile(path);
  std::istringstream lines(text);
  SessionLog log;
  std::string line;
  constexpr long most = 1'000'000'000'000;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string place = path + ":" + std::to_string(number);
    if (lines.eof() && !nlohmann::json::accept(line)) break;  // it was killed while it wrote
    JsonReader reader = JsonReader::parse(line, place);
    if (number == 1) {
      readHead(reader, log);
      if (log.game && log.game->state) log.periods = log.game->state->periods;
      continue;
    }
    if (!log.traceSha256.empty()) throw InputError(place, "a line after the end", "nothing after it");
    const long period = static_cast<long>(reader.integer("period", log.periods, most));
    log.periods = period;
    if (reader.has("end")) {
      reader.flag("end", true);
      log.traceSha256 = reader.text("trace_sha256");
      reader.finish();
      continue;
    }
    if (reader.has("mark")) {
      log.marks.push_back({period, reader.text("mark"), log.acts.size()});
      reader.finish();
      continue;
    }
    nlohmann::json act = reader.node();
    act.erase("period");
    log.acts.push_back({period, actFromJson(act.dump(), place)});
  }
  if (log.gameSha256.empty())
    throw InputError(path, text.empty() ? "an empty file" : "a file that ends within its first line",
                     "a log of btr live or of the scene page");
  return log;
}

bool isSessionLog(const std::string& path) {
  return kindOfFile(path) == FileKind::otherFormat && kindInWords(path).find("uchilsim-log-") != std::string::npos;
}

LogHead headOfSessionLog(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path, std::strerror(errno), "a file that can be read");
  std::string line;
  std::getline(file, line);
  JsonReader reader = JsonReader::parse(line, path + ":1");
  reader.word("format", {"uchilsim-log-1"});
  return {reader.text("game_sha256"), reader.has("game")};
}

}  // namespace btr
