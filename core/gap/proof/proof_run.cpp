#include "core/gap/proof/proof_run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/gap/proof/proof_case.h"
#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_score.h"
#include "core/gap/proof/proof_tally.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// A folder belongs to one trial; more cases may be added to it.
void claimFolder(const ProofRequest& request) {
  std::error_code failure;
  fs::create_directories(request.out, failure);
  if (!fs::is_directory(request.out)) throw InputError(request.out + ": the folder cannot be made");
  const nlohmann::json trial{{"format", "uchilsim-proof-trial-3"},
                             {"seed", request.seed},
                             {"engine", request.engine},
                             {"scene", request.scene},
                             {"kind", request.kind},
                             {"dirt", request.dirt},
                             {"spoiled", request.spoiled},
                             {"analysis_seed", request.options.seed}};
  const std::string text = trial.dump(2) + "\n", path = (fs::path(request.out) / "trial.json").string();
  if (fs::exists(path) && readFile(path) != text)
    throw InputError(path, "another generator, seed, engine, scene, kind or dirt",
                     "the same as in the trial that the folder holds");
  writeFile(path, text);
}

/// What failed, each reason once: what is wrong with a machine is wrong in all cases.
std::string inWords(const std::map<std::size_t, std::string>& failures) {
  constexpr std::size_t mostNamed = 5;
  std::vector<std::pair<std::string, std::vector<std::size_t>>> reasons;  // with the numbers of their cases
  for (const auto& [number, why] : failures) {
    auto known = std::ranges::find(reasons, why, [](const auto& reason) { return reason.first; });
    if (known == reasons.end()) known = reasons.insert(known, {why, {}});
    known->second.push_back(number);
  }
  std::string said;
  for (const auto& [why, numbers] : reasons) {
    said += said.empty() ? "" : "; ";
    said += numbers.size() > 1 ? "cases " : "case ";
    for (std::size_t i = 0; i < std::min(mostNamed, numbers.size()); ++i)
      said += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
    if (numbers.size() > mostNamed) said += " and " + std::to_string(numbers.size() - mostNamed) + " more";
    said += ": " + why;
  }
  return said;
}

}  // namespace

std::string findGenerator() {
  std::string path;
  if (const char* given = std::getenv("UCHILSIM_CONCEAL")) path = given;
  if (path.empty()) path = (fs::read_symlink("/proc/self/exe").parent_path() / "conceal").string();
  if (access(path.c_str(), X_OK) != 0)
    throw InputError(
        path +
        ": the generator of blind cases is not there; it is built with the tests (cmake -DBUILD_TESTING=ON, "
        "target conceal), or name it in UCHILSIM_CONCEAL");
  return path;
}

std::vector<std::size_t> openCases(const ProofRequest& request) {
  claimFolder(request);
  std::vector<std::size_t> open;
  for (std::size_t number = 1; number <= request.cases; ++number)
    if (request.asksFor(number) && !fs::exists(verdictOfCase(request.out, number))) open.push_back(number);
  return open;
}

std::vector<ProvedCase> runProof(const ProofRequest& request, const EffectLibrary& library, const Analyse& analyse,
                                 const std::atomic<bool>& stop,
                                 const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<std::size_t> open = openCases(request);
  std::size_t all = 0;
  for (std::size_t number = 1; number <= request.cases; ++number) all += request.asksFor(number) ? 1 : 0;
  const std::size_t done = all - open.size();
  if (progress) progress(done, all);

  std::map<std::size_t, std::string> failures;  // by number
  const auto settle = [&](std::size_t i, const WorkerPool::Reply& reply) {
    if (!reply.ok) failures[open[i]] = reply.failure;
  };
  const auto tell = [&](std::size_t settled) {
    if (progress) progress(done + settled, all);
  };
  if (!open.empty() && request.force) {
    std::size_t settled = 0;
    request.force->prove(request, open, stop, [&](std::size_t i, const WorkerPool::Reply& reply) {
      settle(i, reply);
      tell(++settled);
    });
  } else if (!open.empty()) {
    WorkerPool pool(
        std::max(1, std::min(request.jobs, static_cast<int>(open.size()))),
        [&](const std::string& job) {
          proveCase(request, std::stoul(job), library, analyse);
          return std::string();
        },
        longestCase_s);
    std::vector<std::string> jobs;
    for (const std::size_t number : open) jobs.push_back(std::to_string(number));
    const auto replies = pool.run(jobs, stop, tell);
    for (std::size_t i = 0; i < replies.size(); ++i) settle(i, replies[i]);
  }

  std::vector<ProvedCase> cases;
  for (std::size_t number = 1; number <= request.cases; ++number)
    if (const std::string path = verdictOfCase(request.out, number); fs::exists(path))
      cases.push_back(provedFromJson(readFile(path), path));
  writeProof(request.out, score(cases), cases);
  if (failures.empty()) return cases;
  // A world that cannot be simulated, say: the others count all the same.
  throw InputError(inWords(failures) + "; the " + std::to_string(cases.size()) + " of " +
                   std::to_string(request.cases) + " that are finished are counted in " +
                   (fs::path(request.out) / "proof.txt").string());
}

}  // namespace btr
