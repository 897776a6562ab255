// Learning and measuring for a long time in one process: does anything grow that should not? `soak [--seconds S]
// [--hours H] [--runs N] [--jobs N] [--analyse]`: 60 s unless told otherwise. Prints a table and what it has to
// complain of (exit code 1).
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/run/export.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/replay.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "tests/soak/watch.h"
#include "tests/temporary_folder.h"

namespace btr::soak {
namespace {

constexpr int runsOfADatabase = 8;  // then a new one is begun and the old one removed with its runs' locks
constexpr double allowed_mb = 8;    // the allocator's own unrest

std::atomic<bool> stop = false;

struct Options {
  double seconds = 60;
  double runs = 1e18;  ///< no more than these
  int jobs = 1;
  bool analyse = false;  ///< also gap analyses, each a process of its own
};

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Short kicks that a person measures, with L3 behind each stage.
ExperimentSpec experiment() {
  const std::string examples = SOURCE_DIR "/resources/experiments";
  nlohmann::json text = nlohmann::json::parse(readFile(examples + "/kick-short.json"));
  text["learner"]["settings"]["population"] = 8;
  text["stages"] = {
      {"first_generations", 3}, {"next_generations", 2}, {"total_generations", 7}, {"measured_individuals", 3}};
  text["adaptation"]["learner"]["settings"]["population"] = 4;
  text["adaptation"]["settings"]["generations"] = 2;
  text["reality"] = "person";
  return experimentFromJson(text.dump(), "soak", examples);
}

class Soak {
 public:
  explicit Soak(const Options& options) : options_(options), host_(PLUGIN_DIR), spec_(experiment()) {}

  std::vector<Held> go() {
    const double begin = now_s();
    std::vector<Held> looks;
    for (std::uint64_t seed = 1;
         !stop && now_s() - begin < options_.seconds && static_cast<double>(seed) <= options_.runs; ++seed) {
      learn(seed);
      if (options_.analyse && seed % 4 == 0) analyse();
      Held held = lookAt(folder_.path().string());
      held.after_s = now_s() - begin;
      held.individuals = individuals_;
      held.measured = measured_;
      held.replays = replays_;
      held.analyses = analyses_;
      looks.push_back(held);
    }
    return looks;
  }

 private:
  // One run from its start to its end, measured by "a person" through a connection of its own, then looked at as the
  // window and the commands do.
  void learn(std::uint64_t seed) {
    const std::string path = folder_.file("soak.db");
    if (seed % runsOfADatabase == 1)
      for (const auto& old : std::filesystem::directory_iterator(folder_.path()))
        std::filesystem::remove_all(old.path());
    Database database = Database::open(path, Database::Mode::create);
    const Id run = startRun(database, host_, spec_, seed);
    RunOptions options;
    options.jobs = options_.jobs;
    RunEnd end = RunEnd::waiting;
    while (!stop && (end = continueRun(database, host_, run, stop, options)) == RunEnd::waiting) measure(path, run);
    if (stop) return;
    look(path, run);
  }

  void measure(const std::string& path, Id run) {
    Database person = Database::open(path, Database::Mode::readWrite);
    const int stage = person.run(run).stage + 1;
    std::vector<MeasurementRecord> values;
    for (const MeasurementTask& task : person.measurementTasks(run, stage))
      for (int repeat = 0; repeat < task.wantedRepeats; ++repeat) {
        MeasurementRecord& value = values.emplace_back();
        value.run = run;
        value.individual = task.individual;
        value.value = 0.9 * task.simulatedFitness;
      }
    measured_ += static_cast<long>(person.addMeasurements(values).size());
  }

  void look(const std::string& path, Id run) {
    const Database reader = Database::open(path, Database::Mode::readOnly);
    const PreparedExperiment prepared = prepareFromRun(reader.run(run), host_);
    for (const char* what : {"generations", "individuals", "gaps", "simulators", "measurements"})
      if (exportCsv(reader, run, what, prepared.genotype, prepared.fitness->unit()).empty())
        throw InputError(std::string("soak: the export of ") + what + " is empty");
    const std::vector<IndividualRecord> all = reader.individuals(run);
    individuals_ += static_cast<long>(all.size());
    for (const std::size_t k : {std::size_t{0}, all.size() - 1}) {
      if (!replay(reader, host_, run, all[k].id).identical)
        throw InputError("soak: the replay of individual " + std::to_string(all[k].id) + " differs");
      ++replays_;
    }
    if (!reader.findings().empty()) throw InputError("soak: " + reader.findings().front());
  }

  // In a process of its own, as the window starts it.
  void analyse() {
    const std::string report = folder_.file("report"), recordings = SOURCE_DIR "/resources/recordings/xl330-made/";
    std::filesystem::remove_all(report);
    const std::vector<std::string> words{BTR_PROGRAM,   "gap",
                                         "analyse",     SOURCE_DIR "/resources/scenes/xl330.json",
                                         "--recording", recordings + "made_kp200_sines.csv",
                                         "--held-out",  recordings + "made_kp200_chirp.csv",
                                         "--out",       report,
                                         "--jobs",      std::to_string(options_.jobs)};
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      execv(BTR_PROGRAM, arguments.data());
      _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw InputError("soak: the gap analysis did not end well");
    ++analyses_;
  }

  const Options options_;
  TemporaryFolder folder_;
  PluginHost host_;
  ExperimentSpec spec_;
  long individuals_ = 0, measured_ = 0, replays_ = 0, analyses_ = 0;
};

bool read(int count, char** arguments, Options& options) {
  for (int k = 1; k < count; ++k) {
    const std::string word = arguments[k];
    const double number = k + 1 < count ? std::atof(arguments[k + 1]) : 0;
    if (word == "--analyse")
      options.analyse = true;
    else if (number <= 0)
      return false;
    else if (word == "--seconds")
      options.seconds = number, ++k;
    else if (word == "--hours")
      options.seconds = 3600 * number, ++k;
    else if (word == "--runs")
      options.seconds = 1e18, options.runs = number, ++k;
    else if (word == "--jobs")
      options.jobs = static_cast<int>(number), ++k;
    else
      return false;
  }
  return true;
}

}  // namespace
}  // namespace btr::soak

int main(int count, char** arguments) {
  using namespace btr::soak;
  Options options;
  if (!read(count, arguments, options)) {
    std::fprintf(stderr, "soak [--seconds S] [--hours H] [--runs N] [--jobs N] [--analyse]\n");
    return 2;
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { stop = true; });
  try {
    const std::vector<Held> looks = Soak(options).go();
    std::fputs(table(looks).c_str(), stdout);
    std::printf("Memory of the second half: %+.2f MB an hour.\n", memoryGrowth_mb_h(looks));
    const std::vector<std::string> found = complaints(looks, runsOfADatabase, allowed_mb);
    for (const std::string& complaint : found) std::printf("%s\n", complaint.c_str());
    if (found.empty()) std::printf("Nothing was lost.\n");
    return found.empty() ? 0 : 1;
  } catch (const btr::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
