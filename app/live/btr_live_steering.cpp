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

LiveSteering::LiveSteering(Session& session, Work work) : session_(session), work_(std::move(work)) {
  if (const RefereeState* referee = session_.referee()) {
    over_ = referee->over;
    eventsTold_ = referee->seen;
  }
}

void LiveSteering::run(const std::atomic<bool>& stop) {
  tellGame();
  if (work_.replay()) tellLog();
  tellRow();
  while (!ended_ && !stop && std::cout.good()) {
    if (!readInput(untilNext_ms())) break;
    if (playing_ || goal_) advance();
  }
}

int LiveSteering::untilNext_ms() const {
  if (goal_) return 0;
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
    const std::string wanted =
        reader.word("do", {"play", "pause", "step", "speed", "save", "save_scene", "save_experiment", "game", "signals",
                           "contacts", "type", "undo", "redo", "go_to", "go_on", "end"});
    if (wanted == "undo" || wanted == "redo") {
      reader.finish();
      ++undos_;
      requireHands();
      return change([&] { wanted == "undo" ? undo_.undo(session_) : undo_.redo(session_); });
    }
    work(wanted, reader);
    const long periods = wanted == "step" ? static_cast<long>(reader.integer("periods", 1, 10000, 1)) : 0;
    reader.finish();
    for (long i = 0; i < periods && stepOnce(); ++i) continue;
    anchor_s_ = measuredFrom_s_ = now_s();
    anchorPeriods_ = measuredPeriods_ = session_.periods();
    factor_ = 0;
    tellRow();
  } catch (const InputError& error) {
    say({{"refused", error.what()}});
  }
}

void LiveSteering::work(const std::string& wanted, JsonReader& reader) {
  if (wanted == "play") playing_ = true;
  if (wanted == "pause") {
    playing_ = false;
    goal_.reset();
  }
  if (wanted == "end") ended_ = true;
  if (wanted == "game") tellGame();
  if (wanted == "signals") chooseSignals(reader);
  if (wanted == "contacts") session_.measureContacts(reader.flag("on", true));
  if (wanted == "speed") speed_ = reader.number("times", 0, 1000);
  if (wanted == "type") {
    requireHands();
    work_.programs()->type(reader.text("robot"), reader.text("text"));
  }
  if (wanted == "go_to") goTo(reader);
  if (wanted == "go_on") {
    if (!work_.replay()) reader.refuse("do", "go_on while a log is played again");
    goal_.reset();
    work_.goOn();
  }
  if (!wanted.starts_with("save")) return;
  const std::string path = reader.text("path");
  if (wanted == "save") {
    if (const nlohmann::json* view = reader.any("view")) session_.setView(view->dump());
    work_.save(path);
  }
  if (wanted == "save_scene") work_.saveScene(path);
  if (wanted == "save_experiment") work_.saveExperiment(path, reader.text("robot", ""));
  say({{"saved", path}, {"what", wanted.size() > 5 ? wanted.substr(5) : "game"}});
}

void LiveSteering::requireHands() const {
  if (work_.replay())
    throw InputError("a hand", "a log that is played again", "hands once it is a session again: go on from here");
}

void LiveSteering::goTo(JsonReader& reader) {
  const LogReplay* replay = work_.replay();
  if (!replay) reader.refuse("do", "go_to while a log is played again");
  const long from = work_.goesBack() || !session_.fault().empty() ? replay->from() : session_.periods();
  const auto period =
      static_cast<long>(reader.integer("period", from, std::max(session_.periods(), replay->log().periods)));
  if (period < session_.periods()) goBack(period);
  goal_ = period;
}

void LiveSteering::goBack(long period) {
  if (!work_.goBack(period)) throw InputError("period", std::to_string(period), "a later one");
  if (session_.referee()) eventsTold_ = session_.referee()->seen;
  over_ = session_.referee() && session_.referee()->over;
  tellGame();
}

void LiveSteering::act(JsonReader& reader) {
  ++acts_;
  requireHands();
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
  tellUndo();
  if (session_.channels() != channels) tellGame();
  if (!refused.empty()) return say({{"refused", refused}});
  tellOverlaps();
  tellRow();
}

void LiveSteering::tellOverlaps() {
  std::vector<std::string> overlaps = overlapsIn(session_);
  if (overlaps == overlapsTold_) return;
  overlapsTold_ = std::move(overlaps);
  say({{"overlaps", overlapsTold_}});
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
  const auto wanted = [&] { return goal_ ? *goal_ : due(); };
  while (session_.periods() < wanted() && now_s() - begin < workAtMost_s && (playing_ || goal_)) {
    if (!stepOnce()) {
      playing_ = false;
      goal_.reset();
      break;
    }
    // The end of a game is a moment to look at: it waits there.
    if (session_.referee() && session_.referee()->over && !over_) {
      over_ = true;
      playing_ = false;
    }
  }
  const double now = now_s();
  if (goal_) {
    anchor_s_ = measuredFrom_s_ = now;
    anchorPeriods_ = measuredPeriods_ = session_.periods();
    factor_ = 0;
    // At its goal it waits for what has to be told there, too.
    if (session_.periods() < *goal_ && now < nextRow_s_) return;
    if (session_.periods() >= *goal_) goal_.reset();
    nextRow_s_ = now + rowEvery_s;
    return tellRow();
  }
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

bool LiveSteering::stepOnce() {
  const LogReplay* replay = work_.replay();
  if (replay) replayActs();
  if (replay && replay->isOver(session_)) return false;
  work_.step();
  if (replay && session_.periods() >= replay->log().periods && session_.fault().empty()) replayActs();
  if (!session_.fault().empty()) return false;
  if (!signals_.wanted()) return true;
  sampled_.clear();
  session_.sample(sampled_);
  signals_.add(session_.periods(), sampled_);
  return true;
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
  gameChanged_ = false;
  signals_.resolve(session_.channels());
  nlohmann::json line = gameLine(session_);
  line["acts"] = acts_;
  line["undos"] = undos_;
  say(line);
  tellOverlaps();
}

// Objects that come or go are told at once: samples belong to the channels that were told.
void LiveSteering::replayActs() {
  const auto channels = session_.channels();
  gameChanged_ |= work_.act();
  if (session_.channels() != channels) tellGame();
}

// Once: what a line of time shows.
void LiveSteering::tellLog() {
  const LogReplay& replay = *work_.replay();
  nlohmann::json acts = nlohmann::json::array();
  for (const NamedActs& each : actsOf(replay.log(), session_.game().scene.controlPeriod_s))
    acts.push_back({each.from, each.to, each.name});
  say({{"log",
        {{"from", replay.from()},
         {"until", replay.log().periods},
         {"marks", replay.log().marks.size()},
         {"goes_back", work_.goesBack()},
         {"acts", std::move(acts)}}}});
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
  OpenrRobots* programs = work_.programs();
  if (!programs) return;
  for (const openr::LivePrograms::Line& said : programs->takeLines())
    line["console"].push_back({said.robot, said.object, said.text});
  if (programs->changes() == programsTold_) return;
  programsTold_ = programs->changes();
  line["programs"] = programs->states();
}

void LiveSteering::tellRow() {
  if (gameChanged_) tellGame();
  nlohmann::json line = rowLine(session_, playing_, factor_);
  if (signals_.wanted()) line["samples"] = signals_.take();
  if (session_.referee()) tellReferee(line);
  tellPrograms(line);
  if (const LogReplay* replay = work_.replay()) {
    nlohmann::json& told = line["replay"];
    told = {{"same_until", replay->sameUntil()}, {"over", replay->isOver(session_)}};
    if (replay->differsBy()) told["differs_by"] = *replay->differsBy();
  }
  say(line);
}

}  // namespace btr::cli
