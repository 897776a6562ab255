#include "core/cluster/element.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/cluster/array_job.h"
#include "core/cluster/build_identity.h"
#include "core/cluster/child.h"
#include "core/cluster/coordinator.h"
#include "core/cluster/own_scratch.h"
#include "core/gap/proof/proof_run.h"
#include "core/run/grid/grid_cells.h"
#include "core/run/loop/back_to_reality.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/scratch_folder.h"
#include "core/store/database.h"

namespace btr {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds betweenStates(5);
constexpr std::chrono::minutes betweenCopies(5);
constexpr int exitDone = 0, exitStopped = 3, exitWaits = 10;

class Element {
 public:
  Element(std::string folder, std::size_t number, const std::string& login)
      : folder_(std::move(folder)), number_(number), job_(loadArrayJob(folder_)) {
    if (number_ < 1 || number_ > job_.elements.size())
      throw InputError(folder_, "element " + std::to_string(number_),
                       "elements 1 to " + std::to_string(job_.elements.size()));
    state_.host = hostName();
    state_.login = login;
    state_.process = getpid();
  }

  void requireSameBuild(const PluginHost& host) {
    std::string why;
    try {
      const auto what = difference(job_.build, isTrial() ? buildIdentity(host, findGenerator()) : buildIdentity(host));
      if (!what) return;
      why = *what + "; install the same build on every machine";
    } catch (const InputError& error) {  // no generator of blind cases
      why = error.what();
    }
    fail("host " + state_.host + ": " + why);
    throw InputError(folder_ + ": element " + std::to_string(number_) + ": " + state_.note);
  }

  bool work(const std::atomic<bool>& stop) try {
    began_ = Clock::now();
    tell("running", "");
    constexpr const char* scratch = "element";
    removeAbandonedScratch(scratch);
    const ScratchFolder local(ownScratchName(scratch));
    if (!isTrial())
      copyFile(elementDatabase(folder_, number_), local.file("element.db"));
    else if (fs::exists(elementCases(folder_, number_)))
      unpackCases(elementCases(folder_, number_), local.file("out"));
    look(local);
    shareBefore_ = state_.share;
    const std::string log = elementFile(folder_, number_, ".log");
    fs::remove(log);
    const pid_t child = startChild(words(local), log);
    const int code = waitFor(child, stop, local);
    const std::string said = readFile(log);
    look(local);
    bringBack(local);
    return conclude(code, stop, lastLine(said));
  } catch (const std::exception& error) {
    fail("host " + state_.host + ": " + error.what());
    return false;
  }

 private:
  bool isTrial() const { return !job_.elements[number_ - 1].cases.empty(); }

  void tell(const std::string& state, const std::string& note) {
    state_.state = state;
    state_.note = note;
    save();
  }
  void save() {
    state_.gained = std::max(0.0, state_.share - shareBefore_);
    state_.worked_s = std::chrono::duration<double>(Clock::now() - began_).count();
    saveElementState(folder_, number_, state_);
    if (state_.login.empty()) return;
    std::printf("%zu %s\n", number_, toJsonText(state_).c_str());
    std::fflush(stdout);
  }
  void fail(const std::string& why) { tell("failed", why); }

  std::vector<std::string> words(const ScratchFolder& local) const {
    std::vector<std::string> all{fs::read_symlink("/proc/self/exe").string()};
    for (const std::string& word : job_.elements[number_ - 1].arguments)
      all.push_back(word == "{db}"       ? local.file("element.db")
                    : word == "{out}"    ? local.file("out")
                    : word == "{places}" ? local.file("places.json")
                                         : word);
    return all;
  }

  static void copyFile(const std::string& from, const std::string& to) {
    std::ifstream in(from, std::ios::binary);
    std::ofstream out(to, std::ios::binary);
    errno = 0;
    if (in && out) out << in.rdbuf() << std::flush;
    if (!in || !out)
      throw InputError((in ? to + ": cannot be written: " : from + ": cannot be read: ") + std::strerror(errno));
  }

  /// Comes back under another name first: whole or not at all.
  void bringBack(const ScratchFolder& local) const {
    if (isTrial()) return packCases(local.file("out"), elementCases(folder_, number_));
    const std::string to = elementDatabase(folder_, number_), part = to + ".part";
    Database::open(local.file("element.db"), Database::Mode::readOnly).backUp(part, true);
    std::error_code error;
    fs::rename(part, to, error);
    if (error) throw InputError(to + ": cannot be written: " + error.message());
  }

  /// Which part is done, and how fast that goes.
  void look(const ScratchFolder& local) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - began_).count();
    if (isTrial()) {
      const std::vector<std::size_t>& cases = job_.elements[number_ - 1].cases;
      const std::size_t finished = finishedCases(local.file("out"), cases);
      state_.share = static_cast<double>(finished) / static_cast<double>(cases.size());
      if (!finishedBefore_) finishedBefore_ = finished;
      state_.trialsPerSecond = elapsed_s > 0 ? static_cast<double>(finished - *finishedBefore_) / elapsed_s : 0;
      return;
    }
    state_.share = shareOf(local.file("element.db"));
    if (const std::string places = local.file("places.json"); fs::exists(places))
      state_.trialsPerSecond = nlohmann::json::parse(readFile(places)).value("trials_per_second", 0.0);
  }

  /// Which part of the generations is done.
  double shareOf(const std::string& database) {
    const Database db = Database::open(database, Database::Mode::readOnly);
    double done = 0, all = 0;
    state_.trialsPerSecond = 0;
    for (const GridRecord& grid : db.grids()) {
      const GridSpec spec = storedGrid(grid.specJson, grid.name);
      const double each = valueOf(gridParameters(), spec.settings, "generations");
      for (const GridCell& cell : cellsOf(spec)) all += cell.mirrorOf == 0 ? each : 0;
    }
    const bool isGrid = all > 0;
    for (const RunRecord& run : db.runs()) {
      const RunProgress progress = progressFromJson(run.progressJson);
      done += run.generation;
      if (!isGrid) all += std::max(progress.totalGenerations, run.generation);
      state_.trialsPerSecond = std::max(state_.trialsPerSecond, progress.trialsPerSecond);
    }
    // Solutions that are tried elsewhere in the end count as generations of a grid's runs, too.
    return all > 0 ? std::min(1.0, done / all) : 0;
  }

  int waitFor(pid_t child, const std::atomic<bool>& stop, const ScratchFolder& local) {
    bool asked = false;
    auto told = Clock::now(), copied = told;
    while (true) {
      int status = 0;
      const pid_t ended = waitpid(child, &status, WNOHANG);
      if (ended == child || (ended < 0 && errno != EINTR)) {
        constexpr int killed = 128;
        return WIFEXITED(status) ? WEXITSTATUS(status) : killed + WTERMSIG(status);
      }
      if (stop && !asked) {
        kill(child, SIGTERM);
        asked = true;
      }
      if (Clock::now() - told > betweenStates) {
        told = Clock::now();
        look(local);
        save();
      }
      if (Clock::now() - copied > betweenCopies) {
        copied = Clock::now();
        bringBack(local);
      }
      constexpr useconds_t moment_us = 50'000;
      usleep(moment_us);
    }
  }

  bool conclude(int code, const std::atomic<bool>& stop, const std::string& said) {
    if (code == exitDone || code == exitWaits) {
      state_.share = 1;
      tell(code == exitDone ? "done" : "waiting", code == exitDone ? "" : said);
      return true;
    }
    if (stop) {
      tell("stopped", "");
      return !state_.login.empty();
    }
    if (code == exitStopped && said.find(": ") == std::string::npos)
      tell("stopped", said);
    else
      fail("host " + state_.host + ": " + (said.empty() ? "exit code " + std::to_string(code) : said));
    return false;
  }

  std::string folder_;
  std::size_t number_;
  ArrayJob job_;
  ElementState state_;
  Clock::time_point began_ = Clock::now();
  double shareBefore_ = 0;                     ///< of what had been done when it began
  std::optional<std::size_t> finishedBefore_;  ///< cases, the same
};

}  // namespace

bool workOnElement(const std::string& folder, std::size_t number, const PluginHost& host, const std::atomic<bool>& stop,
                   const std::string& login) {
  Element element(folder, number, login);
  element.requireSameBuild(host);
  return element.work(stop);
}

}  // namespace btr
