#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cluster/crew.h"
#include "core/cluster/rank_link.h"
#include "core/gap/fit/job_share.h"
#include "core/plugin/plugin_host.h"

namespace btr {

struct CoordinatorOptions {
  int foremen = 1;                               ///< of this rank; 0: it only coordinates
  double secondsPerJob = 120;                    ///< as WorkerPool
  double secondsPerPart = longestAnalysisJob_s;  ///< as secondsPerJob, of a part of an analysis
  double grace_s = 30;      ///< a foreman that tries each job of its piece twice may take this long beyond that
  double patience_s = 120;  ///< how long ranks may take to begin
  ForemanCommand command = ownForeman();
  std::string words = {};  ///< what this process was asked for; every rank must have been asked for the same
};

/// A foreman of a rank, as rank 0 knows it.
struct Member {
  int rank = 0, foreman = 0;
  std::string host;
  bool begun = false, gone = false;
  bool isIdle = true;  ///< it has nothing to do, as far as whoever hands out the work knows
  std::string name() const { return "rank " + std::to_string(rank) + " (host " + host + ")"; }
};

/// The ranks of a job as rank 0 sees them: its own foremen and those of the others, numbered as they came to be known,
/// its own first. All must have the build that this process has. Belongs to one thread.
class Ranks {
 public:
  /// What a member says: its messages (foreman.h), "lost WHY", "gone WHY" (crew.h).
  using Hear = std::function<void(std::size_t member, const Parts&)>;

  /// `link` may be none: only this rank's foremen. `host` must outlive it; its plugins are those that the others must
  /// have.
  Ranks(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options);
  /// Lets all ranks end.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  const CoordinatorOptions& options() const { return options_; }
  std::vector<Member>& members() { return members_; }
  const std::vector<Member>& members() const { return members_; }
  bool areAllGone() const;

  /// Every rank is there and has the same build; once is enough. False if `goesOn` said no. Throws InputError, which
  /// names rank and host, if one has another build or other words or never began.
  bool begin(const std::function<bool()>& goesOn, const Hear& hear);
  /// Takes what has come, waiting a moment for it.
  void listen(const Hear& hear);
  void send(std::size_t member, const Parts& parts);
  /// Ends one that no longer answers, whose "lost" follows.
  void restart(std::size_t member);
  /// Throws InputError if a member's identity, the parts from here to there, is another one than `ours`.
  void requireSame(std::size_t member, const Parts& ours, Parts::const_iterator from, Parts::const_iterator to) const;
  void requireSame(std::size_t member, Parts::const_iterator from, Parts::const_iterator to) const {
    requireSame(member, identity_, from, to);
  }

 private:
  void addMember(int rank, int foreman, const std::string& host);
  void heard(std::size_t member, const Parts& parts, const Hear& hear);
  void takeFromOthers(const Hear& hear, bool& any);
  bool haveAllBegun() const;

  std::unique_ptr<RankLink> link_;
  const CoordinatorOptions options_;
  const Parts identity_;
  std::unique_ptr<Crew> crew_;
  std::vector<Member> members_;
  std::vector<bool> arrived_;  ///< by rank: its crew is known
  bool allBegun_ = false;
  std::chrono::steady_clock::time_point last_;  ///< something was said
};

/// The life of every other rank: starts its foremen and passes on what is said to them and what they say, until rank 0
/// lets it end.
void serveRank(RankLink& link, const CoordinatorOptions& options);

/// How long to wait for a foreman before the link is asked: a moment where something was said lately and nobody here
/// has anything to do, so that neither work is held up nor a processor kept busy with asking.
std::chrono::microseconds momentToWait(std::chrono::steady_clock::duration sinceLast, bool isIdle);

/// This machine's name.
std::string hostName();

/// Every member has a place that reports on it: adds those that are missing, by the members' numbers.
template <class Place>
void addPlaces(const std::vector<Member>& members, std::vector<Place>& places) {
  while (places.size() < members.size()) {
    const Member& member = members[places.size()];
    Place& place = places.emplace_back();
    place.report.rank = member.rank;
    place.report.foreman = member.foreman;
    place.report.host = member.host;
  }
}

}  // namespace btr
