#include "core/live/session_log.h"

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {

std::string gameSha256(const Game& game) {
  Game plain = game;
  plain.view.clear();  // how it is looked at changes nothing
  return sha256(toJsonText(plain));
}

SessionLogWriter::SessionLogWriter(const std::string& path, const Game& game)
    : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_) throw InputError(path, std::strerror(errno), "a file that can be written");
  write(nlohmann::json{{"format", "uchilsim-log-1"}, {"version", UCHILSIM_VERSION}, {"game_sha256", gameSha256(game)}}
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
      reader.word("format", {"uchilsim-log-1"});
      reader.text("version");
      log.gameSha256 = reader.text("game_sha256");
      reader.finish();
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
    nlohmann::json act = reader.node();
    act.erase("period");
    log.acts.push_back({period, actFromJson(act.dump(), place)});
  }
  if (log.gameSha256.empty()) throw InputError(path, "an empty file", "a log of btr live or of the scene page");
  return log;
}

}  // namespace btr
