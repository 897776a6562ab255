#include "core/cluster/analysis/lockstep.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/cluster/analysis/analysis_messages.h"
#include "core/cluster/build_identity.h"
#include "core/cluster/schedule.h"
#include "core/gap/fit/parallel.h"
#include "core/spec/error.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

using Clock = std::chrono::steady_clock;
double sinceThen(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// A job whose foreman was lost so often is at fault, or the machines are.
constexpr int mostLossesOfAJob = 3;
constexpr std::size_t nobody = SIZE_MAX;
struct OpenPiece {
  std::vector<std::size_t> jobs;
  Clock::time_point sent;
};

/// A foreman.
struct Analyst {
  PlaceReport report;
  bool takesPart = true;
  bool wasTold = false;  ///< what is analysed
  bool isReady = false, hasLeft = false;
  bool isAnew = false;  ///< it was lost before, and nobody waits for it
  Parts inputs;
  long call = 0;                     ///< that it has come to
  std::map<long, OpenPiece> pieces;  ///< that it works on
  std::string found;                 ///< hash of its report
};

/// What a call of parallel() came to.
struct Call {
  std::vector<WorkerPool::Reply> replies;
  std::vector<std::size_t> by;  ///< of each: who knows it already, whose it is
};

void rethrow(const std::string& kind, const std::string& why) {
  if (kind == "input") throw InputError(why);
  if (kind == "fault") throw JobFault(why);
  throw std::runtime_error(why);
}

}  // namespace

struct Lockstep::Impl {
  Ranks& ranks;
  const Parts identity;
  const Task task;
  std::vector<Analyst> analysts;  ///< by member
  std::size_t leader = 0;         ///< the first that takes part: it tells the outcome
  std::vector<std::string> notes;
  AnalysisProgress progress;
  std::function<bool()> goesOn;
  Others others;
  int jobs = 0;  ///< worker processes of all, 0: it has not begun

  std::vector<Call> calls;  ///< that are over, all of them
  Call now;                 ///< the present one
  std::size_t open = 0;     ///< jobs of it that are not known
  std::size_t begunBy = 0;  ///< who came to it first
  std::vector<int> losses;  ///< of each job of it
  std::unique_ptr<Schedule> schedule;
  Pace pace;
  long lastPiece = 0;

  std::map<std::size_t, std::string> failedToLoad;  ///< why
  Clock::time_point foundAt;                        ///< by who leads
  std::optional<Clock::time_point> otherFoundAt;    ///< by the first other
  bool isWriting = false;
  double toldShare = 0;
  std::optional<Parts> written;

  Impl(Ranks& all, const PluginHost& host, Task wanted)
      : ranks(all), identity(buildIdentity(host)), task(std::move(wanted)) {
    addPlaces(ranks.members(), analysts);
  }

  bool isThere(std::size_t k) const {
    return analysts[k].takesPart && !ranks.members()[k].gone && !analysts[k].hasLeft;
  }
  std::string nameOf(std::size_t k) const { return ranks.members()[k].name(); }
  std::string leadingRank() const { return "rank " + std::to_string(ranks.members()[leader].rank); }
  long presentCall() const { return static_cast<long>(calls.size()) + 1; }

  void listen() {
    for (std::size_t k = 0; k < analysts.size(); ++k) ranks.members()[k].isIdle = analysts[k].pieces.empty();
    ranks.listen([this](std::size_t k, const Parts& parts) { hear(k, parts); });
    if (!isWriting && !goesOn()) throw Cancelled{};
  }

  void hear(std::size_t k, const Parts& parts) {
    addPlaces(ranks.members(), analysts);
    const std::string& kind = parts.front();
    const bool isOfThis = analysts[k].isReady || isFirstWord(parts), isLost = kind == "lost" || kind == "gone";
    if (isLost && analysts[k].takesPart) lose(k, parts);
    if ((isLost || !isOfThis) && others) others(k, parts);
    if (!isOfThis || isLost) return;
    if (kind == "ready")
      welcome(k, parts);
    else if (kind == "call")
      comeTo(k, std::stol(parts.at(1)), std::stoul(parts.at(2)));
    else if (kind == "done")
      take(k, parts);
    else if (kind == "progress")
      tell(k, parts.at(1), std::stod(parts.at(2)));
    else if (kind == "found")
      find(k, parts.at(1));
    else if (kind == "written")
      written = Parts(parts.begin() + 1, parts.end());
    else if (kind == "failed")
      fail(k, parts.at(2), parts.at(3));
  }

  /// What a foreman says first of this analysis; what comes before is of something that it did until then.
  bool isFirstWord(const Parts& parts) const {
    return (parts[0] == "ready" || parts[0] == "failed") && parts.at(1) == std::to_string(task.number);
  }

  /// Who takes part, of those that are there.
  void choose() {
    addPlaces(ranks.members(), analysts);
    if (task.who == Who::oneOfEachRank) {
      std::map<int, std::size_t> firstOf;  // rank → the one that takes part
      for (std::size_t k = 0; k < analysts.size(); ++k) {
        const Member& member = ranks.members()[k];
        analysts[k].takesPart = !member.gone && firstOf.try_emplace(member.rank, k).second;
        analysts[k].report.workers = 0;
        if (!member.gone) ++analysts[firstOf.at(member.rank)].report.workers;
      }
    }
    while (leader + 1 < analysts.size() && !isThere(leader)) ++leader;
  }

  /// What is analysed, to all who do not know it: in the beginning, and where a foreman was started anew.
  void tellTask() {
    for (std::size_t k = 0; k < analysts.size(); ++k) {
      if (analysts[k].wasTold || !ranks.members()[k].begun || !isThere(k)) continue;
      analysts[k].wasTold = true;
      const int workers = task.who == Who::oneOfEachRank ? analysts[k].report.workers : 0;
      Parts message{task.message.front(), std::to_string(task.number), std::to_string(workers)};
      message.insert(message.end(), task.message.begin() + 1, task.message.end());
      ranks.send(k, message);
    }
  }

  void welcome(std::size_t k, const Parts& parts) {
    constexpr std::ptrdiff_t head = 4;
    ranks.requireSame(k, identity, parts.begin() + head, parts.end());
    Analyst& analyst = analysts[k];
    analyst.isReady = true;
    analyst.report.workers = std::stoi(parts.at(2));
    analyst.inputs = unpack(parts.at(3));
    if (jobs == 0) return;
    // It was started anew: it goes the same way again, with what is known.
    requireSameInputs(k);
    ranks.send(k, {"begin", std::to_string(jobs)});
    for (std::size_t c = 0; c < calls.size(); ++c) sendResults(k, static_cast<long>(c) + 1, calls[c], true);
  }

  void requireSameInputs(std::size_t k) const {
    if (const auto what = difference(analysts[leader].inputs, analysts[k].inputs))
      throw InputError(nameOf(k) + ": " + *what +
                       (task.readsFiles ? "; all machines must read the same files"
                                        : "; it reads the same recordings in another way, take it out"));
  }

  void sendResults(std::size_t to, long number, const Call& call, bool ownToo) {
    Parts message{"all", std::to_string(number)};
    for (std::size_t i = 0; i < call.replies.size(); ++i) {
      if (call.by[i] == to && !ownToo) continue;
      message.push_back(std::to_string(i));
      append(message, call.replies[i]);
    }
    ranks.send(to, message);
  }

  void comeTo(std::size_t k, long number, std::size_t count) {
    analysts[k].call = number;
    const auto index = static_cast<std::size_t>(number - 1);
    std::size_t expected = index < calls.size() ? calls[index].replies.size() : now.replies.size();
    if (number == presentCall() && !schedule) {
      beginCall(count);
      begunBy = k;
      expected = count;
    }
    if (number > presentCall() || expected != count)
      throw InputError(nameOf(k != leader ? k : begunBy) + ": its analysis went another way than that of " +
                       leadingRank() + "; it computes otherwise, take it out");
    if (number == presentCall() && open == 0) endCall();
  }

  void beginCall(std::size_t count) {
    int places = 0;
    for (std::size_t k = 0; k < analysts.size(); ++k)
      if (isThere(k)) places += analysts[k].report.workers;
    now = {};
    now.replies.resize(count);
    now.by.assign(count, nobody);
    losses.assign(count, 0);
    open = count;
    pace.job_s = 0;  // each call's jobs are others; the way there is the same
    schedule = std::make_unique<Schedule>(count, static_cast<std::size_t>(places));
  }

  void endCall() {
    const long number = presentCall();
    for (std::size_t k = 0; k < analysts.size(); ++k)
      if (isThere(k) && analysts[k].isReady) sendResults(k, number, now, false);
    schedule.reset();
    calls.push_back(std::move(now));
  }

  void handOut() {
    if (!schedule) return;
    for (std::size_t k = 0; k < analysts.size(); ++k) {
      Analyst& analyst = analysts[k];
      if (!isThere(k) || analyst.call != presentCall()) continue;
      const auto workers = static_cast<std::size_t>(analyst.report.workers);
      while (true) {
        OpenPiece piece{schedule->next(pace, analyst.pieces.size() / workers), Clock::now()};
        if (piece.jobs.empty()) break;
        Parts message{"jobs", std::to_string(++lastPiece)};
        for (const std::size_t job : piece.jobs) message.push_back(std::to_string(job));
        ranks.send(k, message);
        analyst.pieces.emplace(lastPiece, std::move(piece));
      }
    }
  }

  void take(std::size_t k, const Parts& parts) {
    Analyst& analyst = analysts[k];
    const auto found = analyst.pieces.find(std::stol(parts.at(1)));
    if (found == analyst.pieces.end()) return;
    const OpenPiece piece = std::move(found->second);
    analyst.pieces.erase(found);
    const double worked_s = std::stod(parts.at(2));
    pace.add(piece.jobs.size(), worked_s, sinceThen(piece.sent));
    analyst.report.worked_s += worked_s;
    ++analyst.report.pieces;
    analyst.report.jobs += static_cast<long>(piece.jobs.size());
    for (std::size_t i = 0; i < piece.jobs.size(); ++i) {
      now.replies[piece.jobs[i]] = replyFrom(parts.at(3 + 2 * i), parts.at(4 + 2 * i));
      now.by[piece.jobs[i]] = k;
    }
    open -= piece.jobs.size();
    if (open == 0) endCall();
  }

  void tell(std::size_t k, const std::string& stage, double share) {
    if (k != leader) return;
    toldShare = std::max(toldShare, share);
    if (progress && !progress(stage, toldShare)) throw Cancelled{};
  }

  /// All come to the same: what the first says is the outcome. Of another one it is its machine's.
  void fail(std::size_t k, const std::string& kind, const std::string& why) {
    if (k == leader) rethrow(kind, why);
    if (jobs == 0) {
      failedToLoad.emplace(k, why);
      return;
    }
    analysts[k].hasLeft = true;
    notes.push_back(nameOf(k) + ": it fell out: " + why);
    giveBack(k);
  }

  void giveBack(std::size_t k) {
    for (const auto& [number, piece] : std::exchange(analysts[k].pieces, {}))
      if (schedule) schedule->giveBack(piece.jobs);
  }

  void lose(std::size_t k, const Parts& parts) {
    const std::string why = parts.size() > 1 ? parts[1] : "";
    Analyst& analyst = analysts[k];
    ++analyst.report.losses;
    for (const auto& [number, piece] : analyst.pieces)
      for (const std::size_t job : piece.jobs)
        if (++losses[job] >= mostLossesOfAJob)
          throw JobFault(nameOf(k) +
                         ": the process that worked on the analysis was lost, the third time for this job (" + why +
                         ")");
    giveBack(k);
    std::ranges::replace(now.by, k, nobody);  // who begins anew knows nothing
    analyst.wasTold = analyst.isReady = false;
    analyst.isAnew = true;
    analyst.call = 0;
    analyst.found.clear();
    if (k == leader) isWriting = false;
    if (!ranks.members()[k].gone) return;
    if (k == leader)
      throw JobFault(nameOf(k) + ": the process that leads the analysis cannot be kept alive (" + why + ")");
    notes.push_back(nameOf(k) + ": it fell out: " + why);
  }

  void restartTheHanging() {
    // Others need not wait for anybody to come to the end; who leads and does not follow hangs between two steps.
    if (analysts[leader].found.empty() && otherFoundAt && sinceThen(*otherFoundAt) > ranks.options().patience_s) {
      otherFoundAt = Clock::now();
      ranks.restart(leader);
    }
    for (std::size_t k = 0; k < analysts.size(); ++k) {
      Analyst& analyst = analysts[k];
      if (analyst.pieces.empty()) continue;
      std::size_t held = 0;
      for (const auto& [number, piece] : analyst.pieces) held += piece.jobs.size();
      const double most = ranks.options().grace_s + 2 * ranks.options().secondsPerPart * static_cast<double>(held);
      OpenPiece& oldest = analyst.pieces.begin()->second;
      if (sinceThen(oldest.sent) < most) continue;
      oldest.sent = Clock::now();
      ranks.restart(k);
    }
  }

  /// Everybody has read what is analysed, and the same.
  void begin() {
    if (!ranks.begin(goesOn, [this](std::size_t k, const Parts& parts) { hear(k, parts); })) throw Cancelled{};
    choose();
    const auto isSettled = [this](std::size_t k) {
      return analysts[k].isReady || failedToLoad.contains(k) || !isThere(k);
    };
    const auto allSettled = [&] {
      for (std::size_t k = 0; k < analysts.size(); ++k)
        if (!isSettled(k)) return false;
      return true;
    };
    while (!allSettled()) {
      tellTask();
      listen();
    }
    if (!failedToLoad.empty())
      throw InputError(nameOf(failedToLoad.begin()->first) + ": " + failedToLoad.begin()->second);
    for (std::size_t k = 0; k < analysts.size(); ++k)
      if (isThere(k)) requireSameInputs(k);
    for (std::size_t k = 0; k < analysts.size(); ++k)
      if (isThere(k)) jobs += analysts[k].report.workers;
    for (std::size_t k = 0; k < analysts.size(); ++k)
      if (isThere(k)) ranks.send(k, {"begin", std::to_string(jobs)});
  }

  void find(std::size_t k, const std::string& hash) {
    analysts[k].found = hash;
    if (k == leader)
      foundAt = Clock::now();
    else if (!otherFoundAt)
      otherFoundAt = Clock::now();
  }

  /// Who leads tells its outcome when all who were there from the beginning have come to the same.
  void letWrite() {
    if (isWriting || analysts[leader].found.empty()) return;
    const bool isPatient = sinceThen(foundAt) < ranks.options().patience_s;
    for (std::size_t k = 0; k < analysts.size(); ++k) {
      if (k == leader || !isThere(k) || analysts[k].isAnew) continue;
      if (analysts[k].found.empty() && isPatient) return;
      if (analysts[k].found.empty()) {
        notes.push_back(nameOf(k) + ": it did not come to the end of the analysis in time");
        continue;
      }
      if (analysts[k].found != analysts[leader].found)
        throw InputError(nameOf(k) + ": it came to another report than " + leadingRank() +
                         "; it computes otherwise, take it out");
    }
    isWriting = true;
    ranks.send(leader, {"write"});
  }
};

Lockstep::Lockstep(Ranks& ranks, const PluginHost& host, Task task) : impl_(new Impl(ranks, host, std::move(task))) {}

Lockstep::~Lockstep() {
  const Impl& impl = *impl_;
  for (std::size_t k = 0; k < impl.analysts.size(); ++k)
    if (impl.analysts[k].wasTold && impl.isThere(k)) impl.ranks.send(k, {"end", std::to_string(impl.task.number)});
}

Parts Lockstep::run(const AnalysisProgress& progress, const std::function<bool()>& goesOn, const Others& others) {
  Impl& impl = *impl_;
  impl.progress = progress;
  impl.goesOn = goesOn;
  impl.others = others;
  impl.begin();
  while (!impl.written) {
    impl.tellTask();
    impl.handOut();
    impl.listen();
    impl.restartTheHanging();
    impl.letWrite();
  }
  return *impl.written;
}

std::vector<PlaceReport> Lockstep::report() const {
  std::vector<PlaceReport> all;
  for (const Analyst& analyst : impl_->analysts)
    if (analyst.takesPart) all.push_back(analyst.report);
  return all;
}

const std::vector<std::string>& Lockstep::notes() const { return impl_->notes; }

}  // namespace btr
