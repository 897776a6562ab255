// btr under mpirun and srun: several ranks, of which one works with the database.
#include "app/cluster/btr_cluster.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "core/cluster/build_identity.h"
#include "core/cluster/coordinator.h"
#include "core/cluster/foreman.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/store/network_file.h"

namespace btr::cli {
namespace {

constexpr double longestJob_s = 120;
constexpr std::chrono::seconds betweenPlaces(1);
/// With more ranks than this, rank 0 has enough to do without evaluating trials itself.
constexpr int mostRanksWithAWorkingFirst = 8;

/// What this process was asked for, without the program's name.
std::string ownWords() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string all((std::istreambuf_iterator<char>(file)), {});
  return all.substr(std::min(all.find('\0'), all.size()));
}

struct HostSum {
  int places = 0;
  long pieces = 0, jobs = 0, losses = 0;
  double worked_s = 0;
};

std::map<std::string, HostSum> hostsOf(const std::vector<PlaceReport>& places) {
  std::map<std::string, HostSum> hosts;
  for (const PlaceReport& place : places) {
    HostSum& sum = hosts[place.host];
    sum.places += place.workers;
    sum.pieces += place.pieces;
    sum.jobs += place.jobs;
    sum.losses += place.losses;
    sum.worked_s += place.worked_s;
  }
  return hosts;
}

void requireLocal(const std::string& database) {
  if (const auto system = networkFileSystemOf(database))
    throw InputError(database + ": is on a network file system (" + *system +
                     "), where rank 0 cannot keep a database safely; put it on rank 0's own disk");
}

}  // namespace

int shareOfProcessors() {
  const Launch launch = launchOfThisProcess();
  // Launchers bind their ranks to processors, or say how many ranks are on the machine.
  int here = launch.size;
  for (const char* variable : {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"})
    if (const char* text = std::getenv(variable)) here = std::max(1, std::atoi(text));
  if (const char* text = std::getenv("SLURM_CPUS_PER_TASK")) return std::max(1, std::atoi(text));
  if (launch.by == "srun") return 1;
  return std::max(1, processorCount() / here);
}

RankRole takeRole(Shell& shell, CoordinatorOptions options) {
  RankRole role;
  const Launch launch = launchOfThisProcess();
  if (launch.size <= 1) return role;
  role.isAlone = false;
  role.options = std::move(options);
  role.options.words = ownWords();
  if (launch.rank == 0) {
    buildIdentity(shell.plugins());  // before MPI's libraries are among those that are loaded
    role.link = openMpi(launch);
    return role;
  }
  role.isDone = true;
  std::unique_ptr<RankLink> link;
  try {
    link = openMpi(launch);
  } catch (const InputError&) {
    // What keeps every rank from joining is said once, by rank 0.
    if (launch.by != "srun") throw;
    shell.exitCode = badInput;
    return role;
  }
  serveRank(*link, role.options);
  link->finish();
  return role;
}

void tellHosts(const std::vector<PlaceReport>& places, const char* what) {
  for (const auto& [host, sum] : hostsOf(places))
    std::fprintf(stderr, "btr: %s: %d workers, %ld %s in %ld pieces, %.1f s of work, %ld lost\n", host.c_str(),
                 sum.places, sum.jobs, what, sum.pieces, sum.worked_s, sum.losses);
}

void PlacesFile::begin(const std::string& file) {
  file_ = file;
  tell("", 0, 0, {});
  shareBefore_ = -1;
}

void PlacesFile::tell(const std::string& stage, double share, double jobsPerSecond,
                      const std::vector<PlaceReport>& places, bool isRare, const std::vector<PlaceReport>& analyses) {
  const Clock::time_point now = Clock::now();
  if (file_.empty() || (now - told_ < betweenPlaces && share < 1 && !isRare)) return;
  told_ = now;
  if (shareBefore_ < 0) shareBefore_ = share;
  const double gained = share - shareBefore_, elapsed_s = std::chrono::duration<double>(now - begun_).count();
  nlohmann::json hosts = nlohmann::json::array();
  for (const auto& [host, sum] : hostsOf(places))
    hosts.push_back({{"host", host},
                     {"workers", sum.places},
                     {"pieces", sum.pieces},
                     {"trials", sum.jobs},
                     {"lost", sum.losses},
                     {"worked_s", sum.worked_s}});
  for (const auto& [name, sum] : hostsOf(analyses))
    for (nlohmann::json& host : hosts)
      if (host["host"] == name)
        host["analyses"] = {
            {"parts", sum.jobs}, {"pieces", sum.pieces}, {"lost", sum.losses}, {"worked_s", sum.worked_s}};
  const nlohmann::json all{{"format", "uchilsim-places-1"},
                           {"stage", stage},
                           {"share", share},
                           {"seconds_left", gained > 0 ? elapsed_s * (1 - share) / gained : -1},
                           {"trials_per_second", jobsPerSecond},
                           {"hosts", hosts}};
  writeFile(file_, all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

struct ClusterJob::Impl {
  std::unique_ptr<Coordinator> coordinator;
  PlacesFile places;
};

ClusterJob::ClusterJob(Shell& shell, const std::string& database, int jobs) : impl_(new Impl) {
  CoordinatorOptions options;
  options.secondsPerJob = longestJob_s;
  options.foremen = jobs > 0 ? jobs : shareOfProcessors();
  RankRole role = takeRole(shell, std::move(options));
  isDone_ = role.isDone;
  if (role.isAlone || isDone_) return;
  if (role.link->size() > mostRanksWithAWorkingFirst) role.options.foremen = 0;
  impl_->coordinator = std::make_unique<Coordinator>(std::move(role.link), shell.plugins(), role.options);
  if (!database.empty()) requireLocal(database);
}

ClusterJob::~ClusterJob() = default;

Workforce* ClusterJob::workforce() const { return impl_->coordinator.get(); }

CaseForce* ClusterJob::caseForce() const { return impl_->coordinator.get(); }

void ClusterJob::tell(const char* what) const {
  if (!impl_->coordinator) return;
  tellHosts(impl_->coordinator->report(), what);
  tellHosts(impl_->coordinator->analysisReport(), "parts of gap analyses");
  for (const std::string& note : impl_->coordinator->notes()) std::fprintf(stderr, "btr: %s\n", note.c_str());
}

void ClusterJob::tellTo(const std::string& file) {
  if (!file.empty() && !isDone_) impl_->places.begin(file);
}

void ClusterJob::tellProgress(const std::string& stage, double share, double trialsPerSecond, bool isRare) const {
  if (!impl_->places.isKept()) return;
  using Reports = std::vector<PlaceReport>;
  const Coordinator* all = impl_->coordinator.get();
  impl_->places.tell(stage, share, trialsPerSecond, all ? all->report() : Reports{}, isRare,
                     all ? all->analysisReport() : Reports{});
}

void addPlacesOption(CLI::App* command, std::string& file) {
  command->add_option("--places", file, "keep this JSON file: which machine does how much, how far all is");
}

void addPiecesCommand(CLI::App& app, Shell& shell) {
  auto seconds = std::make_shared<double>(longestJob_s);
  auto workers = std::make_shared<int>(1);
  CLI::App* command = app.add_subcommand("pieces", "work for a rank of btr run under mpirun");
  command->group("");
  command->add_option("--seconds-per-trial", *seconds);
  command->add_option("--workers", *workers);
  command->callback([seconds, workers, &shell] { servePieces(shell.plugins(), *seconds, *workers); });
}

}  // namespace btr::cli
