#include "core/cluster/array_job.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/cluster/child.h"
#include "core/gap/proof/proof_case.h"
#include "core/gap/proof/proof_score.h"
#include "core/gap/proof/proof_tally.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/store/database.h"

namespace btr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr const char* format = "uchilsim-array-1";

json parsed(const std::string& path) {
  try {
    return json::parse(readFile(path));
  } catch (const json::exception&) {
    throw InputError(path, "no JSON", "a file that btr wrote");
  }
}

/// True if all that the other database holds is there already.
bool isTaken(const Database& into, const Database& from) {
  const std::vector<GridRecord> ours = into.grids();
  for (const GridRecord& grid : from.grids())
    if (std::ranges::none_of(ours, [&](const GridRecord& g) {
          return g.specSha256 == grid.specSha256 && g.method == grid.method && g.seed == grid.seed;
        }))
      return false;
  if (!from.grids().empty()) return true;
  for (const RunRecord& run : from.runs())
    if (!into.findRun(from.run(run.id).specSha256, run.seed)) return false;
  return true;
}

/// True if it was new.
bool takeDatabase(const std::string& path, const std::string& into) {
  const Database from = Database::open(path, Database::Mode::readOnly);
  Database to = Database::open(into, Database::Mode::create);
  if (isTaken(to, from)) return false;
  to.merge(path, largestKeptTrace_bytes);
  return true;
}

/// A folder beside what it is moved into, gone in the end.
class Arriving {
 public:
  explicit Arriving(fs::path path) : path_(std::move(path)) { fs::remove_all(path_); }
  ~Arriving() {
    std::error_code ignored;  // the next one begins with removing it
    fs::remove_all(path_, ignored);
  }
  Arriving(const Arriving&) = delete;
  Arriving& operator=(const Arriving&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// True if one of them was new. A case that was begun there and not finished gives way.
bool takeCases(const std::string& tar, const std::string& into) try {
  if (!fs::exists(tar)) return false;
  const Arriving arriving(fs::path(into) / ".arriving");
  unpackCases(tar, arriving.path().string());
  const fs::path trial = arriving.path() / "trial.json", ours = fs::path(into) / "trial.json";
  if (!fs::exists(trial)) return false;
  if (!fs::exists(ours))
    writeFile(ours.string(), readFile(trial.string()));
  else if (readFile(ours.string()) != readFile(trial.string()))
    throw InputError(ours.string(), "another trial", "the one that the job's cases belong to");
  bool isNew = false;
  for (const auto& entry : fs::directory_iterator(arriving.path())) {
    const fs::path there = fs::path(into) / entry.path().filename();
    if (!entry.is_directory() || !fs::exists(entry.path() / "verdict.json") || fs::exists(there / "verdict.json"))
      continue;
    fs::remove_all(there);
    fs::rename(entry.path(), there);
    isNew = true;
  }
  return isNew;
} catch (const fs::filesystem_error& error) {
  throw InputError(into + ": cannot be written: " + error.code().message());
}

void countCases(const std::string& folder) {
  if (!fs::exists(folder)) return;
  const bool any = std::ranges::any_of(fs::directory_iterator(folder), [](const fs::directory_entry& entry) {
    return entry.path().filename().string().starts_with("case_") && fs::exists(entry.path() / "verdict.json");
  });
  if (!any) return;
  const std::vector<ProvedCase> cases = provedCasesIn(folder);
  writeProof(folder, score(cases), cases);
}

}  // namespace

std::string elementCases(const std::string& folder, std::size_t number) { return elementFile(folder, number, ".tar"); }

void packCases(const std::string& trial, const std::string& tar) {
  const std::string part = tar + ".part";
  std::vector<std::string> words{"tar", "-cf", part, "-T", "/dev/null"};
  if (!trial.empty() && fs::exists(fs::path(trial) / "trial.json")) {
    words = {"tar", "-cf", part, "-C", trial, "trial.json"};
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(trial))
      if (entry.path().filename().string().starts_with("case_") && fs::exists(entry.path() / "verdict.json"))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    words.insert(words.end(), names.begin(), names.end());
  }
  outputOfChild(words);
  std::error_code error;
  fs::rename(part, tar, error);
  if (error) throw InputError(tar + ": cannot be written: " + error.message());
}

void unpackCases(const std::string& tar, const std::string& trial) {
  std::error_code error;
  fs::create_directories(trial, error);
  if (error) throw InputError(trial + ": the folder cannot be made: " + error.message());
  outputOfChild({"tar", "-xf", tar, "-C", trial});
}

std::size_t finishedCases(const std::string& trial, const std::vector<std::size_t>& cases) {
  return static_cast<std::size_t>(
      std::ranges::count_if(cases, [&](std::size_t number) { return fs::exists(verdictOfCase(trial, number)); }));
}

std::string elementFile(const std::string& folder, std::size_t number, const std::string& ending) {
  return (fs::path(folder) / (std::to_string(number) + ending)).string();
}

std::string elementDatabase(const std::string& folder, std::size_t number) {
  return elementFile(folder, number, ".db");
}

void claimArrayFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) throw InputError(folder + ": the folder cannot be made: " + error.message());
  if (!fs::is_empty(folder, error))
    throw InputError(folder, "a folder that holds something",
                     "an empty or new one; btr array status says how a job in it is");
}

void saveArrayJob(const std::string& folder, const ArrayJob& job) {
  json elements = json::array();
  for (const ArrayElement& e : job.elements) {
    json element{{"name", e.name}, {"arguments", e.arguments}};
    if (!e.cases.empty()) element["cases"] = e.cases;
    elements.push_back(std::move(element));
  }
  writeFile((fs::path(folder) / "job.json").string(), json{{"format", format},
                                                           {"what", job.what},
                                                           {"into", job.into},
                                                           {"program", job.program},
                                                           {"workers", job.workers},
                                                           {"elements", elements},
                                                           {"build", job.build},
                                                           {"queue_ids", job.queueIds}}
                                                              .dump(1) +
                                                          "\n");
}

ArrayJob loadArrayJob(const std::string& folder) {
  const std::string path = (fs::path(folder) / "job.json").string();
  if (!fs::exists(path)) throw InputError(folder, "no job.json in it", "a folder that btr wrote with --slurm or --ssh");
  const json j = parsed(path);
  if (j.value("format", "") != format) throw InputError(path, j.value("format", "no format"), format);
  try {
    ArrayJob job;
    job.what = j.at("what").get<std::string>();
    job.into = j.at("into").get<std::string>();
    job.program = j.at("program").get<std::string>();
    job.workers = j.at("workers").get<int>();
    for (const json& e : j.at("elements"))
      job.elements.push_back({e.at("name").get<std::string>(), e.at("arguments").get<std::vector<std::string>>(),
                              e.value("cases", std::vector<std::size_t>())});
    job.build = j.at("build").get<Parts>();
    job.queueIds = j.at("queue_ids").get<std::vector<std::string>>();
    return job;
  } catch (const json::exception& error) {
    throw InputError(path, error.what(), "a file that btr wrote");
  }
}

void saveElementState(const std::string& folder, std::size_t number, const ElementState& state) {
  writeFile(elementFile(folder, number, ".json"), toJsonText(state) + "\n");
}

std::string toJsonText(const ElementState& state) {
  json j{{"state", state.state},
         {"host", state.host},
         {"note", state.note},
         {"share", state.share},
         {"gained", state.gained},
         {"worked_s", state.worked_s},
         {"trials_per_second", state.trialsPerSecond}};
  if (!state.login.empty()) {
    j["login"] = state.login;
    j["process"] = state.process;
  }
  return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

namespace {

ElementState stateFrom(const json& j) {
  ElementState s;
  s.state = j.value("state", "");
  s.host = j.value("host", "");
  s.note = j.value("note", "");
  s.share = j.value("share", 0.0);
  s.gained = j.value("gained", 0.0);
  s.worked_s = j.value("worked_s", 0.0);
  s.trialsPerSecond = j.value("trials_per_second", 0.0);
  s.login = j.value("login", "");
  s.process = j.value("process", 0L);
  return s;
}

}  // namespace

ElementState elementStateFromJson(const std::string& text) { return stateFrom(json::parse(text)); }

ElementState loadElementState(const std::string& folder, std::size_t number) {
  const std::string path = elementFile(folder, number, ".json");
  if (!fs::exists(path)) return {};
  try {
    return stateFrom(parsed(path));
  } catch (const json::exception& error) {
    throw InputError(path, error.what(), "a file that btr wrote");
  }
}

// An element's time per part counts what it did since it last began: what was done before took nobody's time that is
// known.
ArrayProgress progressOf(const std::vector<ElementState>& states) {
  ArrayProgress progress;
  double done = 0, gained = 0, worked_s = 0;
  std::size_t running = 0;
  for (const ElementState& s : states) {
    done += s.share;
    gained += s.gained;
    worked_s += s.worked_s;
    if (s.state != "running") continue;
    ++running;
    progress.trialsPerSecond += s.trialsPerSecond;
  }
  if (states.empty()) return progress;
  progress.share = done / static_cast<double>(states.size());
  const double left = static_cast<double>(states.size()) - done;
  if (left <= 0)
    progress.secondsLeft = 0;
  else if (running > 0 && gained > 0)
    progress.secondsLeft = left * worked_s / gained / static_cast<double>(running);
  return progress;
}

Collected collectArray(const std::string& folder) {
  const ArrayJob job = loadArrayJob(folder);
  const bool isTrial = job.what == "gap prove";
  Collected collected;
  for (std::size_t number = 1; number <= job.elements.size(); ++number) {
    const std::string state = loadElementState(folder, number).state;
    const bool isOver = state == "done" || state == "waiting";
    if (!isOver) collected.missing.push_back(number);
    if (!isOver && !isTrial) continue;
    const bool isNew = isTrial ? takeCases(elementCases(folder, number), job.into)
                               : takeDatabase(elementDatabase(folder, number), job.into);
    if (isOver) ++(isNew ? collected.fresh : collected.before);
  }
  if (isTrial) countCases(job.into);
  return collected;
}

}  // namespace btr
