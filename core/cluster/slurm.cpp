#include "core/cluster/slurm.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/cluster/child.h"
#include "core/cluster/ssh_hosts.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// For a shell, as one word.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

/// "1,2,5-7%2" as squeue writes what is still together.
std::vector<std::size_t> numbersOf(const std::string& text) {
  std::vector<std::size_t> numbers;
  std::istringstream parts(text.substr(0, text.find('%')));
  for (std::string part; std::getline(parts, part, ',');) {
    std::size_t first = 0, last = 0;
    char dash = 0;
    std::istringstream in(part);
    if (!(in >> first)) continue;
    last = in >> dash >> last && dash == '-' ? last : first;
    for (std::size_t n = first; n <= last; ++n) numbers.push_back(n);
  }
  return numbers;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ",") + text;
  return all;
}

/// What is left of an element that ended without a word: the last line that its shell or Slurm wrote.
std::string lastWords(const std::string& folder, std::size_t number) {
  for (const char* ending : {".slurm", ".log"})
    if (const std::string path = elementFile(folder, number, ending); fs::exists(path))
      if (std::string line = lastLine(readFile(path)); !line.empty()) return line;
  return "";
}

}  // namespace

std::string ranges(const std::vector<std::size_t>& numbers) {
  std::string all;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    all += (all.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (last > i) all += "-" + std::to_string(numbers[last]);
    i = last + 1;
  }
  return all;
}

void writeSlurmScript(const std::string& folder, const ArrayJob& job, const std::vector<std::string>& options) {
  std::string text = "#!/bin/sh\n#SBATCH --job-name=uchilsim\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=" +
                     std::to_string(job.workers) + "\n#SBATCH --output=" + folder +
                     "/%a.slurm\n"
                     "# A minute before its time is over an element brings back what it has.\n"
                     "#SBATCH --signal=B:TERM@60\n";
  for (const std::string& option : options) text += "#SBATCH " + option + "\n";
  text += "exec " + quoted(job.program) + " element " + quoted(folder) + " \"$SLURM_ARRAY_TASK_ID\"\n";
  writeFile((fs::path(folder) / "job.sh").string(), text);
}

std::string submitToSlurm(const std::string& folder, const std::vector<std::size_t>& numbers) {
  ArrayJob job = loadArrayJob(folder);
  std::string id;
  try {
    id = lastLine(outputOfChild({"sbatch", "--parsable", "--array=" + ranges(numbers), "--chdir=" + folder,
                                 (fs::path(folder) / "job.sh").string()}));
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; the job is written: btr array resume " + folder +
                     " gives it to Slurm again");
  }
  id = id.substr(0, id.find(';'));  // a cluster's name may follow
  job.queueIds.push_back(id);
  saveArrayJob(folder, job);
  return id;
}

std::map<std::size_t, std::string> heldBySlurm(const ArrayJob& job) {
  std::map<std::size_t, std::string> held;
  for (const std::string& id : job.queueIds) {
    const ChildEnd end = runChild({"squeue", "--noheader", "--array", "--jobs=" + id, "--format=%K %T"});
    // Slurm forgets what ended some minutes ago.
    if (end.exitCode != 0 && end.err.find("Invalid job id") != std::string::npos) continue;
    if (end.exitCode != 0) throw InputError("squeue: " + lastLine(end.err));
    std::istringstream lines(end.out);
    for (std::string elements, word; lines >> elements >> word;)
      for (const std::size_t number : numbersOf(elements)) held[number] = word;
  }
  return held;
}

void cancelInSlurm(const ArrayJob& job) {
  if (job.queueIds.empty()) throw InputError("this job was never given to Slurm");
  std::vector<std::string> words{"scancel"};
  // Elements get the time to bring back what they have: not only their shell is told.
  words.insert(words.end(), job.queueIds.begin(), job.queueIds.end());
  const ChildEnd end = runChild(words);
  if (end.exitCode != 0 && end.err.find("Invalid job id") == std::string::npos)
    throw InputError("scancel " + joined(job.queueIds) + ": " + lastLine(end.err));
}

std::vector<ElementState> arrayStates(const std::string& folder, const ArrayJob& job) {
  std::vector<ElementState> states;
  std::map<std::size_t, std::string> held;
  const bool here = isWorkedOnOverSsh(folder);
  if (!job.queueIds.empty()) held = heldBySlurm(job);
  for (std::size_t number = 1; number <= job.elements.size(); ++number) {
    ElementState state = loadElementState(folder, number);
    const auto queued = held.find(number);
    const bool isOver = state.state == "done" || state.state == "waiting";
    if (here) {
      // Those whose turn has not come stand with nothing.
      if (state.state.empty() && job.queueIds.empty()) state.state = "queued";
    } else if (queued != held.end() && !isOver) {
      if (queued->second != "RUNNING" && queued->second != "COMPLETING") state = {"queued", "", queued->second, 0};
    } else if (!job.queueIds.empty() && (state.state == "running" || state.state.empty())) {
      const std::string last = lastWords(folder, number);
      state.note = (state.host.empty() ? "" : "host " + state.host + ": ") + "it ended without a word" +
                   (last.empty() ? "" : ": " + last);
      state.state = "failed";
    } else if (job.queueIds.empty() && state.state == "running") {
      state.state = "stopped";
      state.note = "what worked on it over ssh is gone";
    }
    if (state.state.empty()) state.state = "not begun";
    states.push_back(state);
  }
  return states;
}

}  // namespace btr
