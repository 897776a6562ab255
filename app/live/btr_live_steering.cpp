#include "app/live/btr_live_steering.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "app/live/btr_live_lines.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

constexpr double rowEvery_s = 0.02;     ///< 50 pictures a second are enough for an eye
constexpr double workAtMost_s = 0.03;   ///< then standard input is looked at again
constexpr double behindAtMost_s = 0.2;  ///< what cannot be caught up is given up: the factor tells
constexpr double measured_s = 0.5;      ///< the real-time factor's window
constexpr std::size_t longestLine = 1u << 20;
constexpr std::size_t mostSignals = 100;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void say(const nlohmann::json& line) {
  // The watchdog tells from a thread of its own.
  static std::mutex oneAtATime;
  const std::lock_guard lock(oneAtATime);
  std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n' << std::flush;
}

}  // namespace

void tellLine(const nlohmann::json& line) { say(line); }

LiveSteering::LiveSteering(Session& session, OpenrRobots& openr, std::function<void(const std::string&)> save)
    : session_(session), openr_(openr), save_(std::move(save)) {
  if (const RefereeState* referee = session_.referee()) {
    over_ = referee->over;
    eventsTold_ = referee->seen;
  }
}

void LiveSteering::run(const std::atomic<bool>& stop) {
  tellGame();
  tellRow();
  while (!ended_ && !stop && std::cout.good()) {
    if (!readInput(untilNext_ms())) break;
    if (playing_) advance();
  }
}

int LiveSteering::untilNext_ms() const {
  if (!playing_) return 200;  // Ctrl-C is noticed
  if (speed_ <= 0) return 0;
  const double period = session_.game().scene.controlPeriod_s / speed_;
  const double due = anchor_s_ + static_cast<double>(session_.periods() - anchorPeriods_ + 1) * period;
  return std::clamp(static_cast<int>(1000 * (due - now_s())), 0, 200);
}

bool LiveSteering::readInput(int wait_ms) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  const int ready = poll(&input, 1, wait_ms);
  if (ready <= 0) return ready == 0 || errno == EINTR;
  char bytes[65536];
  const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
  if (count <= 0) return count < 0 && errno == EINTR;
  pending_.append(bytes, static_cast<std::size_t>(count));
  std::size_t begin = 0;
  for (std::size_t end; !ended_ && (end = pending_.find('\n', begin)) != std::string::npos; begin = end + 1)
    obey(pending_.substr(begin, end - begin));
  pending_.erase(0, begin);
  if (pending_.size() <= longestLine) return true;
  say({{"refused", "a line of more than a megabyte"}});
  return false;
}

void LiveSteering::obey(const std::string& line) {
  if (line.find_first_not_of(" \t\r") == std::string::npos) return;
  try {
    JsonReader reader = JsonReader::parse(line, "line");
    if (reader.has("act")) return act(reader);
    const std::string wanted = reader.word(
        "do", {"play", "pause", "step", "speed", "save", "game", "signals", "contacts", "type", "undo", "redo", "end"});
    if (wanted == "play") playing_ = true;
    if (wanted == "pause") playing_ = false;
    if (wanted == "end") ended_ = true;
    if (wanted == "game") tellGame();
    if (wanted == "undo" || wanted == "redo") {
      reader.finish();
      return change([&] { wanted == "undo" ? undo_.undo(session_) : undo_.redo(session_); });
    }
    if (wanted == "signals") chooseSignals(reader);
    if (wanted == "contacts") session_.measureContacts(reader.flag("on", true));
    if (wanted == "speed") speed_ = reader.number("times", 0, 1000);
    if (wanted == "type") openr_.type(reader.text("robot"), reader.text("text"));
    if (wanted == "save") {
      const std::string path = reader.text("path");
      if (const nlohmann::json* view = reader.any("view")) session_.setView(view->dump());
      save_(path);
      say({{"saved", path}});
    }
    const long periods = wanted == "step" ? static_cast<long>(reader.integer("periods", 1, 10000, 1)) : 0;
    reader.finish();
    for (long i = 0; i < periods; ++i) stepOnce();
    anchor_s_ = measuredFrom_s_ = now_s();
    anchorPeriods_ = measuredPeriods_ = session_.periods();
    factor_ = 0;
    tellRow();
  } catch (const InputError& error) {
    say({{"refused", error.what()}});
  }
}

void LiveSteering::act(JsonReader& reader) {
  std::optional<long> gesture;
  if (reader.has("gesture")) gesture = static_cast<long>(reader.integer("gesture", 0, 1'000'000'000));
  nlohmann::json act = reader.node();
  act.erase("gesture");
  const Act wanted = actFromJson(act.dump(), "line");
  change([&] { undo_.apply(session_, wanted, gesture); });
}

void LiveSteering::change(const std::function<void()>& work) {
  const auto channels = session_.channels();
  std::string refused;
  try {
    work();
  } catch (const InputError& error) {
    refused = error.what();
  }
  if (session_.channels() != channels) tellGame();
  tellUndo();
  if (!refused.empty()) return say({{"refused", refused}});
  tellRow();
}

void LiveSteering::tellUndo() {
  if (undo_.undoName() == undoTold_ && undo_.redoName() == redoTold_) return;
  undoTold_ = undo_.undoName();
  redoTold_ = undo_.redoName();
  say({{"undo", undoTold_}, {"redo", redoTold_}});
}

void LiveSteering::advance() {
  const double begin = now_s(), period = session_.game().scene.controlPeriod_s;
  const auto due = [&] {
    if (speed_ <= 0) return session_.periods() + 1;
    return anchorPeriods_ + static_cast<long>(std::floor((now_s() - anchor_s_) * speed_ / period));
  };
  while (session_.periods() < due() && now_s() - begin < workAtMost_s && session_.fault().empty() && playing_) {
    stepOnce();
    // The end of a game is a moment to look at: it waits there.
    if (session_.referee() && session_.referee()->over && !over_) {
      over_ = true;
      playing_ = false;
    }
  }
  const double now = now_s();
  if (speed_ > 0 && static_cast<double>(due() - session_.periods()) * period / speed_ > behindAtMost_s) {
    anchor_s_ = now;
    anchorPeriods_ = session_.periods();
  }
  if (now - measuredFrom_s_ >= measured_s) {
    factor_ = static_cast<double>(session_.periods() - measuredPeriods_) * period / (now - measuredFrom_s_);
    measuredFrom_s_ = now;
    measuredPeriods_ = session_.periods();
  }
  if (!session_.fault().empty()) playing_ = false;
  if (now < nextRow_s_ && playing_) return;
  nextRow_s_ = now + rowEvery_s;
  tellRow();
}

void LiveSteering::stepOnce() {
  openr_.step();
  session_.step();
  if (!signals_.wanted() || !session_.fault().empty()) return;
  sampled_.clear();
  session_.sample(sampled_);
  signals_.add(session_.periods(), sampled_);
}

// What was kept of the channels before is told first, so that every sample belongs to the channels that were told last.
void LiveSteering::chooseSignals(JsonReader& reader) {
  std::vector<std::string> wanted = reader.texts("channels");
  if (wanted.size() > mostSignals) reader.refuse("channels", "at most " + std::to_string(mostSignals) + " names");
  if (signals_.wanted()) tellRow();
  signals_.choose(std::move(wanted), session_.channels());
  say({{"signals", signals_.names()}});
}

void LiveSteering::tellGame() {
  signals_.resolve(session_.channels());
  say(gameLine(session_));
}

void LiveSteering::tellReferee(nlohmann::json& line) {
  addReferee(session_, line, eventsTold_);
  eventsTold_ = session_.referee()->seen;
}

void addReferee(const Session& session, nlohmann::json& line, long from) {
  const RefereeState& referee = *session.referee();
  line["score"] = {referee.red, referee.blue};
  line["clock_s"] = static_cast<double>(referee.periods) * session.game().scene.controlPeriod_s;
  line["half"] = referee.half;
  line["over"] = referee.over;
  const long fresh = std::min(referee.seen - from, static_cast<long>(referee.events.size()));
  if (fresh <= 0) return;
  line["events"] = nlohmann::json::array();
  for (auto event = referee.events.end() - fresh; event != referee.events.end(); ++event)
    line["events"].push_back(toJson(*event));
}

void LiveSteering::tellPrograms(nlohmann::json& line) {
  for (const openr::LivePrograms::Line& said : openr_.takeLines())
    line["console"].push_back({said.robot, said.object, said.text});
  if (openr_.changes() == programsTold_) return;
  programsTold_ = openr_.changes();
  line["programs"] = openr_.states();
}

void LiveSteering::tellRow() {
  nlohmann::json line = rowLine(session_, playing_, factor_);
  if (signals_.wanted()) line["samples"] = signals_.take();
  if (session_.referee()) tellReferee(line);
  tellPrograms(line);
  say(line);
}

}  // namespace btr::cli
