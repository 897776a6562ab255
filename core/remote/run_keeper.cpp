#include "core/remote/run_keeper.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/remote/desk.h"
#include "core/remote/frame.h"

namespace btr::remote {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

double allowedPatience(double wanted_s) {
  constexpr double most_s = 86400;
  return std::min(wanted_s, most_s);
}

}  // namespace

struct RunKeeper::Work {
  Id run = 0;
  double patience_s = 0;
  long order = 0;                ///< in which runs began
  std::shared_ptr<Child> child;  ///< none once it is over
  std::mutex mutex;
  std::condition_variable changed;
  std::string question;                ///< JSON that waits for an answer; else ""
  long number = 0;                     ///< of the last question
  long taken = 0;                      ///< of the last one that was answered
  bool answering = false;              ///< an answer is on its way to the learner
  std::optional<std::string> refused;  ///< what the learner said of it; "" if it was taken
  Clock::time_point asked;
  std::string stopping;  ///< why it is to stop; "" while it is not
  bool endTold = false, over = false;
  RunNews::What end = RunNews::What::stopped;
  std::string message;
  std::thread follower;

  ~Work() {
    if (const auto process = running()) process->kill("the server ends");
    if (follower.joinable()) follower.join();
  }

  std::shared_ptr<Child> running() {
    const std::lock_guard lock(mutex);
    return child;
  }

  void hear(const std::string& line) {
    const json object = json::parse(line);
    const std::lock_guard lock(mutex);
    if (object.contains("ask")) {
      number = object.at("ask").get<long>();
      question = line;
      asked = Clock::now();
      if (!stopping.empty()) tellEnd(stopping);  // it had not looked yet whether it is to stop
    } else if (object.contains("taken")) {
      taken = number;
      question.clear();
      refused = "";
    } else {
      refused = object.at("refused").get<std::string>();
    }
    changed.notify_all();
  }

  void stop(const std::string& why) {
    stopping = why;
    if (!question.empty()) tellEnd(why);
  }

  void tellEnd(const std::string& why) {
    if (endTold) return;
    endTold = true;
    // Its learner only listens: who has no room for a line is stuck.
    if (child && sendBytes(child->line(), json{{"end", why}}.dump() + "\n", 0) != Sent::whole) child->kill(why);
  }

  void finish(const Answer& answer) {
    const std::lock_guard lock(mutex);
    over = true;
    question.clear();
    if (answer.code != Code::ok)
      message = answer.bytes;
    else if (answer.bytes == "finished")
      end = RunNews::What::finished;
    else if (answer.bytes == "waiting")
      end = RunNews::What::waiting;
    if (!refused) refused = "the run has stopped";
    child.reset();  // ends the process: what it did is stored
    changed.notify_all();
  }
};

// What the run's process asks by itself, until it is over.
Answer RunKeeper::follow(Work& work) {
  std::string pending;
  const std::shared_ptr<Child> child = work.running();
  const int socket = child->socket(), line = child->line();
  constexpr double patience_s = 10;
  if (sendFrame(socket, callOf(Method::work, std::to_string(work.run)), patience_s) != Sent::whole)
    return {Code::unavailable, "the run's process has ended"};
  while (true) {
    pollfd both[2] = {{socket, POLLIN, 0}, {line, POLLIN, 0}};
    constexpr int look_ms = 200;
    if (poll(both, 2, look_ms) < 0 && errno != EINTR) return {Code::internal, "poll failed"};
    if (both[1].revents != 0) {
      char bytes[65536];
      const ssize_t n = recv(line, bytes, sizeof bytes, MSG_DONTWAIT);
      if (n > 0) pending.append(bytes, static_cast<std::size_t>(n));
      for (std::size_t end; (end = pending.find('\n')) != std::string::npos; pending.erase(0, end + 1))
        work.hear(pending.substr(0, end));
      if (n > 0) continue;
    }
    if (both[0].revents != 0) {
      std::string frame;
      if (receiveFrame(socket, frame, patience_s, {}, patience_s) != Got::frame || frame.empty())
        return {Code::unavailable, "the run's process has ended; what it did is stored"};
      return {static_cast<Code>(frame[0]), frame.substr(1)};
    }
    const std::lock_guard lock(work.mutex);
    if (!work.question.empty() && Clock::now() - work.asked > std::chrono::duration<double>(work.patience_s))
      work.tellEnd("it has not answered for " + std::to_string(static_cast<long>(work.patience_s)) +
                   " s; continue the run at any time");
  }
}

void RunKeeper::stopAll(const std::function<void(Id)>& request, double patience_s) {
  std::map<Id, std::shared_ptr<Work>> works;
  {
    const std::lock_guard lock(mutex_);
    works = works_;
  }
  const auto until =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience_s));
  for (const auto& [run, work] : works) {
    {
      const std::lock_guard lock(work->mutex);
      if (work->over) continue;
      work->stop("the server ends; continue the run at any time");
    }
    request(run);
  }
  for (const auto& [run, work] : works) {
    std::unique_lock lock(work->mutex);
    work->changed.wait_until(lock, until, [&work = *work] { return work.over; });
  }
}

std::shared_ptr<RunKeeper::Work> RunKeeper::find(Id run) const {
  const std::lock_guard lock(mutex_);
  const auto found = works_.find(run);
  return found == works_.end() ? nullptr : found->second;
}

void RunKeeper::begin(Id run, double patience_s) {
  std::vector<std::shared_ptr<Work>> forgotten;  // end outside of the lock
  const std::lock_guard lock(mutex_);
  std::size_t active = 0;
  for (const auto& [id, work] : works_) {
    const std::lock_guard each(work->mutex);
    if (work->over) continue;
    if (id == run && !work->stopping.empty())
      throw Refusal(Code::notNow, "run " + std::to_string(run) + " is still about to stop; continue it when it has");
    if (id == run) {
      if (patience_s > 0) work->patience_s = allowedPatience(patience_s);
      return;
    }
    ++active;
  }
  if (active >= most)
    throw Refusal(Code::tooMuch, "this server works on " + std::to_string(most) + " runs already; stop one or wait");
  auto work = std::make_shared<Work>();
  work->run = run;
  work->order = ++begun_;
  constexpr double usual_s = 600;
  work->patience_s = patience_s > 0 ? allowedPatience(patience_s) : usual_s;
  work->child = nursery_.start('r');
  work->follower = std::thread([&w = *work] {
    try {
      w.finish(follow(w));
    } catch (const std::exception& error) {
      w.finish({Code::internal, std::string("what the run's process says cannot be read: ") + error.what()});
    }
  });
  if (auto& known = works_[run]; known) forgotten.push_back(std::move(known));
  works_[run] = std::move(work);
  for (auto& each : takeForgotten()) forgotten.push_back(std::move(each));
}

std::vector<std::shared_ptr<RunKeeper::Work>> RunKeeper::takeForgotten() {
  std::vector<std::shared_ptr<Work>> over;
  for (const auto& [run, work] : works_)
    if (const std::lock_guard lock(work->mutex); work->over) over.push_back(work);
  std::ranges::sort(over, {}, &Work::order);
  over.resize(over.size() - std::min(over.size(), mostRemembered));
  for (const auto& work : over) works_.erase(work->run);
  return over;
}

bool RunKeeper::isHere(Id run) const {
  const auto work = find(run);
  if (!work) return false;
  const std::lock_guard lock(work->mutex);
  return !work->over;
}

bool RunKeeper::isToStop(Id run) const {
  const auto work = find(run);
  if (!work) return false;
  const std::lock_guard lock(work->mutex);
  return !work->over && !work->stopping.empty();
}

void RunKeeper::awaitEnd(Id run, double patience_s) const {
  const auto work = find(run);
  if (!work) return;
  std::unique_lock lock(work->mutex);
  work->changed.wait_for(lock, std::chrono::duration<double>(patience_s), [&] { return work->over; });
}

RunNews RunKeeper::news(Id run, double wait_s, const std::function<bool()>& cancelled) {
  const auto work = find(run);
  if (!work) return {RunNews::What::notHere, 0, "", ""};
  const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait_s));
  std::unique_lock lock(work->mutex);
  while (true) {
    if (work->over) return {work->end, 0, "", work->message};
    if (!work->question.empty() && !work->endTold) {
      work->asked = Clock::now();  // whoever asks is there
      return {RunNews::What::asks, work->number, work->question, ""};
    }
    if (Clock::now() >= until || cancelled()) return {};
    work->changed.wait_for(lock, std::chrono::milliseconds(100));
  }
}

void RunKeeper::tell(Id run, long number, const std::string& answer) {
  const auto work = find(run);
  const std::string name = "run " + std::to_string(run);
  if (!work) throw Refusal(Code::notNow, name + " is not worked on by this server; continue it first");
  std::unique_lock lock(work->mutex);
  constexpr double patience_s = 30;
  constexpr auto patience = std::chrono::seconds(static_cast<int>(patience_s));
  if (!work->changed.wait_for(lock, patience, [&] { return !work->answering; }))
    throw Refusal(Code::tooLate, "another answer to " + name + " is still on its way");
  if (work->over) throw Refusal(Code::notNow, name + " is over: " + work->message);
  // Learners of two levels count each for itself: what is asked now comes before what was taken already.
  const bool asked = !work->question.empty() && number == work->number;
  if (!asked && number == work->taken && number > 0) return;
  if (!asked)
    throw Refusal(Code::notNow,
                  name + " has not asked question " + std::to_string(number) +
                      (work->question.empty() ? "; it asks none now" : "; it asks " + std::to_string(work->number)));
  work->answering = true;
  work->refused.reset();
  const std::shared_ptr<Child> child = work->child;
  lock.unlock();
  // The learner reads at once. Who does not is stuck, and half an answer would spoil the next one.
  const Sent sent = sendBytes(child->line(), answer + "\n", patience_s);
  if (sent == Sent::nothing) child->kill("its learner does not take an answer");
  lock.lock();
  work->changed.wait_for(lock, patience, [&] { return work->refused.has_value(); });
  work->answering = false;
  work->changed.notify_all();
  if (!work->refused) throw Refusal(Code::tooLate, name + " has not taken the answer");
  if (!work->refused->empty()) throw Refusal(Code::invalid, *work->refused);
}

void RunKeeper::end(Id run, const std::string& why) {
  const auto work = find(run);
  if (!work) return;
  const std::lock_guard lock(work->mutex);
  work->stop(why);
}

}  // namespace btr::remote
