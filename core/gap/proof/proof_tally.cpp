#include "core/gap/proof/proof_tally.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_text.h"
#include "core/gap/proof/proved_case.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

std::vector<ProvedCase> casesOfFolder(const std::string& folder) {
  std::vector<ProvedCase> cases;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path verdict = entry.path() / "verdict.json";
    if (entry.path().filename().string().starts_with("case_") && fs::exists(verdict))
      cases.push_back(provedFromJson(readFile(verdict.string()), verdict.string()));
  }
  std::ranges::sort(cases, {}, [](const ProvedCase& proved) { return proved.answer.number; });
  return cases;
}

std::vector<ProvedCase> casesOfLines(const std::string& path) {
  constexpr std::size_t largest = std::size_t{1} << 28;
  std::vector<ProvedCase> cases;
  std::istringstream lines(readFile(path, largest));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    if (!line.empty()) cases.push_back(provedFromJson(line, path + ":" + std::to_string(number)));
  return cases;
}

}  // namespace

std::vector<ProvedCase> provedCasesIn(const std::string& path) {
  std::vector<ProvedCase> cases = fs::is_directory(path) ? casesOfFolder(path) : casesOfLines(path);
  if (cases.empty())
    throw InputError(path, "no finished case",
                     "the folder of a blind trial (btr gap prove --out), or a file of its cases");
  return cases;
}

std::vector<ProvedCase> provedCasesIn(const std::vector<std::string>& paths) {
  std::vector<ProvedCase> all;
  std::map<std::string, std::string> placeOf;  // by answer: each ends in a salt
  for (const std::string& path : paths)
    for (ProvedCase& proved : provedCasesIn(path)) {
      const auto [first, isNew] = placeOf.emplace(toJsonText(proved.answer), path);
      if (!isNew)
        throw InputError(path,
                         "case " + std::to_string(proved.answer.number) + " of seed " +
                             std::to_string(proved.answer.seed) + " again (it is in " + first->second + ")",
                         "each case once");
      all.push_back(std::move(proved));
    }
  return all;
}

std::string linesOf(const std::vector<ProvedCase>& cases) {
  std::string text;
  for (const ProvedCase& proved : cases) text += nlohmann::json::parse(toJsonText(proved)).dump() + "\n";
  return text;
}

void writeProof(const std::string& folder, const ProofScore& total, const std::vector<ProvedCase>& cases) {
  const fs::path out(folder);
  writeFile((out / "proof.json").string(), proofJson(total, cases));
  writeFile((out / "proof.txt").string(), proofText(total));
  writeFile((out / "proof.html").string(), proofHtml(total));
}

}  // namespace btr
