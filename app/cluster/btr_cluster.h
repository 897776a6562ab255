#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/btr_commands.h"
#include "core/cluster/coordinator.h"
#include "core/gap/proof/proof_request.h"
#include "core/run/setup/workforce.h"

namespace btr::cli {

/// What this process is among the ranks that mpirun or srun started.
struct RankRole {
  bool isAlone = true;
  bool isDone = false;              ///< it worked for rank 0 until that one ended
  std::unique_ptr<RankLink> link;   ///< of rank 0
  CoordinatorOptions options = {};  ///< of rank 0
};
/// Worker processes of a rank that was not told how many: its share of its machine's processors.
int shareOfProcessors();
/// Takes part, as `options` say: a rank other than the first returns when rank 0 lets it. MPI is loaded on the way.
RankRole takeRole(Shell& shell, CoordinatorOptions options);
/// Who did how much, on stderr: a line for each host.
void tellHosts(const std::vector<PlaceReport>& places, const char* what);

/// A JSON file ("uchilsim-places-1") of who does how much. Without a name nothing is written.
class PlacesFile {
 public:
  /// Writes it for the first time, if it has a name. Throws InputError if it cannot be written.
  void begin(const std::string& file);
  /// At most once a second, and at the end: which part of all (0 to 1) is done, by whom; `analyses`: who made parts of
  /// gap analyses beside that. `isRare`: every time.
  void tell(const std::string& stage, double share, double jobsPerSecond, const std::vector<PlaceReport>& places,
            bool isRare = false, const std::vector<PlaceReport>& analyses = {});
  bool isKept() const { return !file_.empty(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::string file_;
  Clock::time_point begun_ = Clock::now(), told_ = begun_ - std::chrono::hours(1);
  double shareBefore_ = -1;  ///< of what had been done when it began; negative: not known yet
};

/// This process as one of the ranks that mpirun or srun started; nothing is loaded where it was started alone.
class ClusterJob {
 public:
  /// As `btr run` and others begin. On rank 0: the database, if there is one, must not be on a network file system
  /// (InputError), and the workforce begins. On every other rank: works for rank 0 until that one ends. `jobs`: worker
  /// processes of each rank, 0: this rank's share of its machine's processors.
  ClusterJob(Shell& shell, const std::string& database, int jobs);
  ~ClusterJob();
  ClusterJob(const ClusterJob&) = delete;
  ClusterJob& operator=(const ClusterJob&) = delete;

  /// True on the ranks that only work: what they were asked for is done.
  bool isDone() const { return isDone_; }
  Workforce* workforce() const;  ///< none where the process was started alone
  CaseForce* caseForce() const;  ///< the same
  /// Who did how much, on stderr: a line for each host. `what`: its jobs are.
  void tell(const char* what = "trials") const;
  /// From now on tellProgress() keeps a PlacesFile; of rank 0. Throws InputError if it cannot be written.
  void tellTo(const std::string& file);
  /// At most once a second: which part of all (0 to 1) is done. `isRare`: every time.
  void tellProgress(const std::string& stage, double share, double trialsPerSecond, bool isRare = false) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool isDone_ = false;
};

/// --places.
void addPlacesOption(CLI::App* command, std::string& file);

/// pieces: works for a rank; not in the list of commands.
void addPiecesCommand(CLI::App& app, Shell& shell);

}  // namespace btr::cli
