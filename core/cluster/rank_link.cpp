#include "core/cluster/rank_link.h"

#include <dlfcn.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

/// A whole number from the environment, −1 if there is none.
int numberFrom(const char* variable) {
  const char* text = std::getenv(variable);
  if (!text) return -1;
  int value = -1;
  const char* end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, value);
  return read.ec == std::errc() && read.ptr == end ? value : -1;
}

std::string moduleBesideCore() {
  Dl_info info{};
  std::string (*const inCore)(const std::string&) = &sha256;
  if (dladdr(reinterpret_cast<void*>(inCore), &info) == 0 || !info.dli_fname) return "libbtr_mpi.so";
  return (std::filesystem::path(info.dli_fname).parent_path() / "libbtr_mpi.so").string();
}

}  // namespace

Launch launchOfThisProcess() {
  if (numberFrom("UCHILSIM_ALONE") == 1) return {};
  struct Names {
    const char *rank, *size, *by;
  };
  // Open MPI's mpirun, Slurm's srun, and other mpiruns.
  for (const Names& names :
       {Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "mpirun"},
        Names{"SLURM_PROCID", "SLURM_STEP_NUM_TASKS", "srun"}, Names{"PMI_RANK", "PMI_SIZE", "mpirun"}}) {
    const int rank = numberFrom(names.rank), size = numberFrom(names.size);
    if (rank >= 0 && size > 1) return {rank, size, names.by};
  }
  return {};
}

std::unique_ptr<RankLink> openMpi(const Launch& launch) {
  // MPI itself would end the process with a page of text.
  if (launch.by == "srun" && !std::getenv("PMIX_RANK") && !std::getenv("PMI_RANK"))
    throw InputError("srun started " + std::to_string(launch.size) +
                     " tasks that MPI cannot join; start it with srun --mpi=pmix, or set UCHILSIM_ALONE=1 for a run of "
                     "its own in each");
  const std::string path = moduleBesideCore();
  if (!std::filesystem::exists(path))
    throw InputError(launch.by + " started " + std::to_string(launch.size) +
                     " ranks, and this btr was built without MPI; install libopenmpi-dev and build again, or start it "
                     "alone");
  // MPI's own modules look for its symbols among those of everybody.
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!module) throw InputError(path + ": cannot be loaded: " + dlerror());
  const auto open = reinterpret_cast<RankLink* (*)()>(dlsym(module, "btrOpenMpi"));
  if (!open) throw InputError(path, "another module", "the one that was built with this btr");
  std::unique_ptr<RankLink> link(open());
  if (link->size() != launch.size)
    throw InputError(launch.by + " started " + std::to_string(launch.size) + " ranks, and MPI sees " +
                     std::to_string(link->size()) +
                     (launch.by == "srun" ? "; start it with srun --mpi=pmix" : "; use the mpirun of Open MPI"));
  return link;
}

}  // namespace btr
