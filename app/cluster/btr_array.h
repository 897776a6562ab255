#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/btr_commands.h"
#include "core/cluster/array_job.h"

namespace btr::cli {

/// Where a command's parts are worked on elsewhere.
struct ArrayArguments {
  std::string slurm, ssh, hosts;     ///< folders of the job; file of hosts
  std::vector<std::string> options;  ///< of sbatch
  bool isWanted() const { return !slurm.empty() || !ssh.empty(); }
  std::string folder() const { return slurm.empty() ? ssh : slurm; }
};
/// --slurm, --slurm-option, --ssh, --hosts.
void addArrayOptions(CLI::App* command, ArrayArguments& arguments);

/// Writes the job and gives it to the queue or to the hosts. `begin` makes the elements, and the databases of those
/// that have one, in the folder.
void beginArray(const ArrayArguments& arguments, ArrayJob job,
                const std::function<void(const std::string& folder, ArrayJob& job)>& begin, Shell& shell);

void addArrayCommands(CLI::App& app, Shell& shell);  ///< array, and element, which is not in the list

}  // namespace btr::cli
