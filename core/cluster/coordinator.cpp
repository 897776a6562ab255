#include "core/cluster/coordinator.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <thread>
#include <utility>

#include "core/cluster/analysis/analysis_messages.h"
#include "core/cluster/analysis/lockstep.h"
#include "core/cluster/blind_cases.h"
#include "core/cluster/build_identity.h"
#include "core/cluster/experiment_message.h"
#include "core/cluster/schedule.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// Cases are taken for so long until some have been measured: nobody keeps a second one waiting meanwhile.
constexpr Pace paceOfCases{30, 0};

/// A job that was lost so often is at fault, or the machines are.
constexpr int mostTries = 3;

struct Piece {
  long number = 0;
  std::vector<std::size_t> jobs;
  Clock::time_point sent;
  bool abandoned = false;  ///< of work that was stopped: nobody waits for it
};

struct Place {
  PlaceReport report;
  std::string why;               ///< it was lost
  long task = 0;                 ///< the last one that it was told
  std::deque<Piece> pieces;      ///< in the order in which it works on them
  Clock::time_point since = {};  ///< when it began with the first of them
};

/// To what is known of the same places.
void addUp(const std::vector<PlaceReport>& reports, std::vector<PlaceReport>& all) {
  for (const PlaceReport& report : reports) {
    const auto same = std::ranges::find_if(
        all, [&](const PlaceReport& a) { return a.rank == report.rank && a.foreman == report.foreman; });
    if (same == all.end()) {
      all.push_back(report);
      continue;
    }
    same->workers = report.workers;
    same->pieces += report.pieces;
    same->jobs += report.jobs;
    same->losses += report.losses;
    same->worked_s += report.worked_s;
  }
}

}  // namespace

struct Coordinator::Impl {
  const PluginHost& host;
  Ranks ranks;
  std::vector<Place> places;  ///< by member
  long task = 0, lastPiece = 0;
  Parts taskText;         ///< as it was sent, without its number
  std::string generator;  ///< that conceals the task's cases, if it has such
  Pace paceOfTrials, paceOfBlindCases = paceOfCases;
  std::vector<PlaceReport> analysed;   ///< of analyses that are over
  const Lockstep* lockstep = nullptr;  ///< while there is one
  std::vector<std::string> notes;
  long analyses = 0;

  // Of the work that is done now.
  std::function<void(std::size_t, WorkerPool::Reply)> settle;  ///< a job came to its end
  Pace* pace = nullptr;
  double secondsPerJob = 0;
  std::vector<int> tries;
  Schedule* schedule = nullptr;
  std::size_t finished = 0;

  Impl(std::unique_ptr<RankLink> link, const PluginHost& plugins, CoordinatorOptions wanted)
      : host(plugins), ranks(std::move(link), plugins, std::move(wanted)) {
    addPlaces(ranks.members(), places);
  }

  const Member& memberOf(const Place& place) const {
    return ranks.members()[static_cast<std::size_t>(&place - places.data())];
  }
  std::size_t numberOf(const Place& place) const { return static_cast<std::size_t>(&place - places.data()); }

  void listen() {
    for (Place& place : places) ranks.members()[numberOf(place)].isIdle = place.pieces.empty();
    ranks.listen([this](std::size_t member, const Parts& parts) { hear(member, parts); });
  }

  void requireSame(std::size_t member, Parts::const_iterator from, Parts::const_iterator to) const {
    ranks.requireSame(member, generator.empty() ? buildIdentity(host) : buildIdentity(host, generator), from, to);
  }

  void hear(std::size_t member, const Parts& parts) {
    addPlaces(ranks.members(), places);
    Place& place = places[member];
    const std::string& kind = parts.front();
    if (kind == "ready") {
      if (std::stol(parts[1]) == task) requireSame(member, parts.begin() + 2, parts.end());
    } else if (kind == "refused") {
      if (std::stol(parts[1]) == task) throw InputError(memberOf(place).name() + ": " + parts[2]);
    } else if (kind == "done") {
      take(place, parts);
    } else if (kind == "lost" || kind == "gone") {
      lose(place, parts);
    }
  }

  void take(Place& place, const Parts& parts) {
    const long number = std::stol(parts[1]);
    if (place.pieces.empty() || place.pieces.front().number != number) return;
    const Piece piece = std::move(place.pieces.front());
    place.pieces.pop_front();
    place.since = Clock::now();
    const double worked_s = std::stod(parts[2]);
    place.report.worked_s += worked_s;
    place.report.pieces += 1;
    place.report.jobs += static_cast<long>(piece.jobs.size());
    if (piece.abandoned) return;
    pace->add(piece.jobs.size(), worked_s, secondsSince(piece.sent));
    for (std::size_t i = 0; i < piece.jobs.size(); ++i) {
      const std::size_t job = piece.jobs[i];
      const std::string& state = parts[3 + 2 * i];
      // Killed twice from outside: another machine may have more memory.
      if (state == "K" && ++tries[job] < mostTries) {
        schedule->giveBack({job});
        continue;
      }
      WorkerPool::Reply reply;
      reply.ok = state == "R";
      reply.killed = state == "K";
      (reply.ok ? reply.bytes : reply.failure) = parts[4 + 2 * i];
      ++finished;
      settle(job, std::move(reply));
    }
  }

  void lose(Place& place, const Parts& parts) {
    place.why = parts.size() > 1 ? parts[1] : "";
    place.task = 0;
    if (!lockstep) ++place.report.losses;
    bool first = true;
    for (const Piece& piece : std::exchange(place.pieces, {})) {
      if (!piece.abandoned) {
        // What it worked on was among the first piece's jobs.
        if (first)
          for (const std::size_t job : piece.jobs)
            if (++tries[job] >= mostTries)
              throw InputError(memberOf(place).name() +
                               ": the process that worked on a trial was lost, the third time for this "
                               "trial (" +
                               place.why + "); what was stored before is kept: the same command goes on");
        schedule->giveBack(piece.jobs);
      }
      first = false;
    }
    if (ranks.areAllGone())
      throw InputError(memberOf(place).name() + ": no place is left that works (" + place.why +
                       "); what was stored is kept: the same command goes on");
  }

  bool begin(const std::atomic<bool>& stop) {
    const bool isThere =
        ranks.begin([&stop] { return !stop; }, [this](std::size_t member, const Parts& parts) { hear(member, parts); });
    addPlaces(ranks.members(), places);
    return isThere;
  }

  /// What all jobs are of; nothing new if it is the same as before.
  void setTask(Parts text) {
    if (task > 0 && text == taskText) return;
    taskText = std::move(text);
    ++task;
  }

  /// All jobs of the task; false if stopped.
  bool work(const std::vector<std::string>& jobs, const std::atomic<bool>& stop,
            const std::function<void(std::size_t)>& done) {
    Schedule all(jobs.size(), static_cast<std::size_t>(
                                  std::ranges::count_if(ranks.members(), [](const Member& m) { return !m.gone; })));
    schedule = &all;
    tries.assign(jobs.size(), 0);
    finished = 0;
    std::size_t told = 0;
    while (finished < jobs.size()) {
      if (stop) {
        for (Place& place : places)
          for (Piece& piece : place.pieces) piece.abandoned = true;
        return false;
      }
      handOut(jobs);
      listen();
      restartTheHanging();
      while (told < finished)
        if (++told; done) done(told);
    }
    return true;
  }

  void handOut(const std::vector<std::string>& jobs) {
    for (Place& place : places) {
      if (memberOf(place).gone || !memberOf(place).begun) continue;
      while (true) {
        std::vector<std::size_t> numbers = schedule->next(*pace, place.pieces.size());
        if (numbers.empty()) break;
        if (place.task != task) {
          Parts text = taskText;
          text[1] = std::to_string(task);
          ranks.send(numberOf(place), text);
          place.task = task;
        }
        Piece piece{++lastPiece, std::move(numbers), Clock::now(), false};
        Parts message{"piece", std::to_string(piece.number)};
        for (const std::size_t job : piece.jobs) message.push_back(jobs[job]);
        ranks.send(numberOf(place), message);
        if (place.pieces.empty()) place.since = piece.sent;
        place.pieces.push_back(std::move(piece));
      }
    }
  }

  void restartTheHanging() {
    for (Place& place : places) {
      if (place.pieces.empty()) continue;
      const double most =
          ranks.options().grace_s + 2 * secondsPerJob * static_cast<double>(place.pieces.front().jobs.size());
      if (secondsSince(place.since) < most) continue;
      place.since = Clock::now();
      ranks.restart(numberOf(place));
    }
  }
};

/// The ranks belong to an analysis while this lives; then the foremen know no task any more.
class Coordinator::LentRanks {
 public:
  LentRanks(Impl& impl, const Lockstep& lockstep) : impl_(impl) { impl_.lockstep = &lockstep; }
  ~LentRanks() {
    for (Place& place : impl_.places) place.task = 0;
    addUp(impl_.lockstep->report(), impl_.analysed);
    impl_.notes.insert(impl_.notes.end(), impl_.lockstep->notes().begin(), impl_.lockstep->notes().end());
    impl_.lockstep = nullptr;
  }
  LentRanks(const LentRanks&) = delete;
  LentRanks& operator=(const LentRanks&) = delete;

 private:
  Impl& impl_;
};

Coordinator::Coordinator(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options)
    : impl_(new Impl(std::move(link), host, std::move(options))) {}

Coordinator::~Coordinator() = default;

int Coordinator::workers() const { return std::max(1, static_cast<int>(impl_->places.size())); }

std::vector<PlaceReport> Coordinator::report() const {
  std::vector<PlaceReport> all;
  for (const Place& place : impl_->places) all.push_back(place.report);
  return all;
}

std::vector<PlaceReport> Coordinator::analysisReport() const {
  std::vector<PlaceReport> all = impl_->analysed;
  if (impl_->lockstep) addUp(impl_->lockstep->report(), all);
  return all;
}

std::vector<std::string> Coordinator::notes() const { return impl_->notes; }

std::vector<WorkerPool::Reply> Coordinator::run(const PreparedExperiment& experiment,
                                                const std::vector<std::string>& jobs, const std::atomic<bool>& stop,
                                                const std::function<void(std::size_t)>& done) {
  Impl& impl = *impl_;
  if (!impl.begin(stop)) return {};
  impl.generator.clear();
  Parts task = experimentParts(makeRunRecord(experiment, 0, 0));
  task.insert(task.begin(), {"experiment", "0"});
  impl.setTask(std::move(task));
  impl.pace = &impl.paceOfTrials;
  impl.secondsPerJob = impl.ranks.options().secondsPerJob;
  std::vector<WorkerPool::Reply> replies(jobs.size());
  impl.settle = [&](std::size_t job, WorkerPool::Reply reply) { replies[job] = std::move(reply); };
  if (!impl.work(jobs, stop, done)) return {};
  return replies;
}

RecordedFinding Coordinator::analyse(const PreparedExperiment& experiment, const RecordedAnalysis& analysis,
                                     const AnalysisProgress& progress, const std::function<bool()>& goesOn) {
  Impl& impl = *impl_;
  Lockstep::Task task;
  task.message = experimentParts(makeRunRecord(experiment, 0, 0));
  task.message.insert(task.message.begin(), {"repair", pack(analysis)});
  task.number = ++impl.analyses;
  task.who = Lockstep::Who::oneOfEachRank;
  task.readsFiles = false;
  Lockstep lockstep(impl.ranks, impl.host, std::move(task));
  const LentRanks lent(impl, lockstep);
  return findingFrom(
      lockstep.run(progress, goesOn, [&impl](std::size_t k, const Parts& parts) { impl.hear(k, parts); }));
}

void Coordinator::prove(const ProofRequest& request, const std::vector<std::size_t>& numbers,
                        const std::atomic<bool>& stop,
                        const std::function<void(std::size_t, const WorkerPool::Reply&)>& done) {
  Impl& impl = *impl_;
  if (!impl.begin(stop)) return;
  impl.generator = request.generator;
  impl.setTask({"cases", "0", toJsonText(request)});
  impl.pace = &impl.paceOfBlindCases;
  impl.secondsPerJob = longestCase_s;
  std::vector<std::string> jobs;
  for (const std::size_t number : numbers) jobs.push_back(std::to_string(number));
  impl.settle = [&](std::size_t job, const WorkerPool::Reply& reply) {
    if (reply.ok) takeCase(request.out, numbers[job], reply.bytes);
    done(job, reply);
  };
  impl.work(jobs, stop, {});
}

}  // namespace btr
