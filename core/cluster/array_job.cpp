#include "core/cluster/array_job.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/cluster/child.h"
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

bool takeCases(const std::string& path, const std::string& into) {
  fs::create_directories(into);
  bool isNew = false;
  const std::string list = outputOfChild({"tar", "-tf", path});
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find('\n', at), list.size());
    const std::string name = list.substr(at, end - at);
    if (name.ends_with("verdict.json") && !fs::exists(fs::path(into) / name)) isNew = true;
    at = end + 1;
  }
  if (isNew) outputOfChild({"tar", "-xf", path, "-C", into});
  return isNew;
}

}  // namespace

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
  for (const ArrayElement& e : job.elements) elements.push_back({{"name", e.name}, {"arguments", e.arguments}});
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
      job.elements.push_back({e.at("name").get<std::string>(), e.at("arguments").get<std::vector<std::string>>()});
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
  Collected collected;
  for (std::size_t number = 1; number <= job.elements.size(); ++number) {
    const std::string state = loadElementState(folder, number).state;
    if (state != "done" && state != "waiting") {
      collected.missing.push_back(number);
      continue;
    }
    const bool isNew = job.what == "gap prove" ? takeCases(elementFile(folder, number, ".tar"), job.into)
                                               : takeDatabase(elementDatabase(folder, number), job.into);
    ++(isNew ? collected.fresh : collected.before);
  }
  return collected;
}

}  // namespace btr
