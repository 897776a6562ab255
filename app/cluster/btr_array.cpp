// Array jobs: parts of a comparison, of grids or of a blind trial in Slurm's queue or on other machines over ssh.
#include "app/cluster/btr_array.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/duration.h"
#include "core/cluster/build_identity.h"
#include "core/cluster/child.h"
#include "core/cluster/element.h"
#include "core/cluster/slurm.h"
#include "core/cluster/ssh_hosts.h"
#include "core/spec/error.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

std::string whole(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

std::vector<std::size_t> allOf(const ArrayJob& job) {
  std::vector<std::size_t> numbers;
  for (std::size_t n = 1; n <= job.elements.size(); ++n) numbers.push_back(n);
  return numbers;
}

std::vector<std::size_t> unfinished(const std::vector<ElementState>& states) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (const std::string& s = states[i].state; s == "failed" || s == "stopped" || s == "not begun")
      numbers.push_back(i + 1);
  return numbers;
}

/// ", about 1:05:00 left"; empty where it is not known.
std::string timeLeft(double seconds) { return seconds > 0 ? ", about " + duration(seconds) + " left" : ""; }

void printStates(const std::string& folder, const ArrayJob& job, const std::vector<ElementState>& states,
                 Shell& shell) {
  nlohmann::json all = nlohmann::json::array();
  const ArrayProgress progress = progressOf(states);
  std::vector<std::vector<std::string>> rows;
  const bool areCases = job.what == "gap prove";
  constexpr double hour_s = 3600;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ElementState& s = states[i];
    all.push_back({{"element", i + 1},
                   {"name", job.elements[i].name},
                   {"state", s.state},
                   {"host", s.host},
                   {"share", s.share},
                   {"trials_per_second", s.trialsPerSecond},
                   {"note", s.note}});
    rows.push_back({std::to_string(i + 1), job.elements[i].name, s.state, tenthPercent(s.share), s.host,
                    s.trialsPerSecond > 0 ? brief(s.trialsPerSecond * (areCases ? hour_s : 1)) : "", s.note});
  }
  if (shell.json)
    return printJson({{"format", "uchilsim-array-status-1"},
                      {"what", job.what},
                      {"into", job.into},
                      {"is_slurms", !job.queueIds.empty()},
                      {"is_worked_on_over_ssh", isWorkedOnOverSsh(folder)},
                      {"workers", job.workers},
                      {"share", progress.share},
                      {"seconds_left", progress.secondsLeft},
                      {"trials_per_second", progress.trialsPerSecond},
                      {"elements", all}});
  writeOut("", table({"element", "what", "state", "done", "host", areCases ? "cases/h" : "trials/s", ""}, rows));
  std::printf("all: %s%s\n", tenthPercent(progress.share).c_str(), timeLeft(progress.secondsLeft).c_str());
}

void overSsh(const std::string& folder, const std::string& hosts, const std::vector<std::size_t>& numbers,
             Shell& shell) {
  runOverSsh(folder, whole(hosts), numbers, *shell.stop);
  const ArrayJob job = loadArrayJob(folder);
  const std::vector<ElementState> states = arrayStates(folder, job);
  printStates(folder, job, states, shell);
  if (!unfinished(states).empty()) shell.exitCode = stoppedEarly;
}

struct FolderArguments {
  std::string folder, hosts, login;
  std::size_t number = 0;
};

void resume(const FolderArguments& a, Shell& shell) {
  const ArrayJob job = loadArrayJob(a.folder);
  const std::vector<std::size_t> numbers = unfinished(arrayStates(a.folder, job));
  if (numbers.empty()) {
    std::printf("%s: nothing is left that could go on\n", a.folder.c_str());
    return;
  }
  if (!a.hosts.empty()) return overSsh(a.folder, a.hosts, numbers, shell);
  for (const std::size_t number : numbers) {
    ElementState fresh = loadElementState(a.folder, number);
    if (!fresh.state.empty()) saveElementState(a.folder, number, {"", "", "", fresh.share});
  }
  const std::string id = submitToSlurm(a.folder, numbers);
  std::printf("elements %s of %s are Slurm's job %s\n", ranges(numbers).c_str(), a.folder.c_str(), id.c_str());
}

void collect(const FolderArguments& a, Shell& shell) {
  const ArrayJob job = loadArrayJob(a.folder);
  const Collected collected = collectArray(a.folder);
  if (shell.json) {
    printJson({{"into", job.into},
               {"collected", collected.fresh},
               {"collected_before", collected.before},
               {"missing", collected.missing}});
  } else {
    std::printf("%s: %zu elements collected, %zu had been before, %zu of %zu are missing%s\n", job.into.c_str(),
                collected.fresh, collected.before, collected.missing.size(), job.elements.size(),
                collected.missing.empty() ? "" : (" (" + ranges(collected.missing) + ")").c_str());
  }
  if (!collected.missing.empty()) shell.exitCode = stoppedEarly;
}

}  // namespace

void addArrayOptions(CLI::App* command, ArrayArguments& a) {
  CLI::Option* slurm =
      command->add_option("--slurm", a.slurm, "do not work here: write an array job to this folder, give it to Slurm");
  command->add_option("--slurm-option", a.options, "for sbatch, --slurm-option=--partition=short (repeatable)")
      ->allow_extra_args(false)
      ->needs(slurm);
  CLI::Option* ssh =
      command->add_option("--ssh", a.ssh, "do not work here: write the job to this folder, work on it on --hosts")
          ->excludes(slurm);
  CLI::Option* hosts = command->add_option("--hosts", a.hosts, "file of machines that ssh reaches, one a line");
  ssh->needs(hosts);
  hosts->needs(ssh);
}

void beginArray(const ArrayArguments& a, ArrayJob job,
                const std::function<void(const std::string& folder, ArrayJob& job)>& begin, Shell& shell) {
  const std::string folder = whole(a.folder());
  if (!a.hosts.empty()) requireHosts(a.hosts);
  claimArrayFolder(folder);
  job.into = whole(job.into);
  job.program = fs::read_symlink("/proc/self/exe").string();
  job.build = buildIdentity(shell.plugins());
  begin(folder, job);
  saveArrayJob(folder, job);
  if (!a.ssh.empty()) return overSsh(folder, a.hosts, allOf(job), shell);
  writeSlurmScript(folder, job, a.options);
  const std::string id = submitToSlurm(folder, allOf(job));
  if (shell.json) return printJson({{"folder", folder}, {"elements", job.elements.size()}, {"queue_id", id}});
  std::printf("%zu elements in %s are Slurm's job %s; btr array status %s\n", job.elements.size(), folder.c_str(),
              id.c_str(), folder.c_str());
}

void addArrayCommands(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<FolderArguments>();
  CLI::App* array = app.add_subcommand("array", "jobs that compare, grid or gap prove wrote with --slurm or --ssh");
  array->require_subcommand(1);
  const auto add = [&](const char* name, const char* what) {
    CLI::App* command = array->add_subcommand(name, what);
    command->add_option("FOLDER", a->folder, "the job's folder")->required()->transform([](const std::string& path) {
      return whole(path);
    });
    return command;
  };
  add("status", "how each element is: queued, running, done, waiting, stopped or failed, and why")
      ->callback([a, &shell] {
        const ArrayJob job = loadArrayJob(a->folder);
        printStates(a->folder, job, arrayStates(a->folder, job), shell);
      });
  add("collect", "bring the results of what is done into the database or folder of the command")->callback([a, &shell] {
    collect(*a, shell);
  });
  add("cancel", "stop it, in Slurm's queue or over ssh; what is done is kept")->callback([a] {
    const ArrayJob job = loadArrayJob(a->folder);
    if (isWorkedOnOverSsh(a->folder) || job.queueIds.empty()) return stopOverSsh(a->folder);
    cancelInSlurm(job);
  });
  CLI::App* again = add("resume", "work again on elements that failed, were stopped or have not begun, alone");
  again->add_option("--hosts", a->hosts, "on these machines in place of Slurm");
  again->callback([a, &shell] { resume(*a, shell); });

  CLI::App* element = app.add_subcommand("element", "work on one element of an array job");
  element->group("");
  element->add_option("FOLDER", a->folder)->required();
  element->add_option("NUMBER", a->number)->required();
  element->add_option("--login", a->login);
  element->callback([a, &shell] {
    if (!workOnElement(whole(a->folder), a->number, shell.plugins(), *shell.stop, a->login))
      shell.exitCode = stoppedEarly;
  });
}

}  // namespace btr::cli
