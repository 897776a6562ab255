#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/cluster/array_job.h"

namespace btr {

/// Writes FOLDER/job.sh, the script of the array; `options` are sbatch's own, "--partition=short", one a line.
void writeSlurmScript(const std::string& folder, const ArrayJob& job, const std::vector<std::string>& options);

/// Gives elements of the job to Slurm and notes the number of the queue's job. Throws InputError in one sentence with
/// what sbatch says.
std::string submitToSlurm(const std::string& folder, const std::vector<std::size_t>& numbers);

/// The elements that Slurm still holds, with its word for how they are ("PENDING", "RUNNING"). Throws InputError if it
/// does not answer.
std::map<std::size_t, std::string> heldBySlurm(const ArrayJob& job);

/// Takes the job out of the queue; elements that are worked on bring back what they have.
void cancelInSlurm(const ArrayJob& job);

/// "1-3,7" of ascending numbers.
std::string ranges(const std::vector<std::size_t>& numbers);

/// How all elements are, what the queue says included: an element that says "running" and that no queue holds any more
/// has failed without a word.
std::vector<ElementState> arrayStates(const std::string& folder, const ArrayJob& job);

}  // namespace btr
