#include "core/cluster/blind_cases.h"

#include <algorithm>
#include <filesystem>

#include "core/cluster/coordinator.h"
#include "core/cluster/own_scratch.h"
#include "core/cluster/parts.h"
#include "core/gap/proof/proof_case.h"
#include "core/gap/report/run_analysis.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/scratch_folder.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// What the first of the parts says of the rest.
constexpr const char *isProved = "proved", *hasNoRoom = "no room";

/// False where a file of some size cannot be written any more.
bool hasRoom(const fs::path& folder) {
  constexpr std::size_t size = 1 << 20;
  const std::string probe = (folder / "probe").string();
  std::error_code ignored;
  try {
    writeFile(probe, std::string(size, 'x'));
  } catch (const InputError&) {
    fs::remove(probe, ignored);
    return false;
  }
  fs::remove(probe, ignored);
  return true;
}

/// Name and content of every file, by name, after what they are.
Parts filesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(folder).string());
  std::sort(names.begin(), names.end());
  Parts parts{isProved};
  for (const std::string& name : names) {
    parts.push_back(name);
    parts.push_back(readFile((folder / name).string()));
  }
  return parts;
}

}  // namespace

std::string proveAway(ProofRequest request, std::size_t number, const EffectLibrary& library) {
  const ScratchFolder scratch(ownScratchName(caseScratch));
  request.out = scratch.path().string();
  try {
    proveCase(request, number, library,
              [](const AnalysisRequest& asked, const EffectLibrary& effects) { return runAnalysis(asked, effects); });
  } catch (const InputError& error) {
    const std::string why = "host " + hostName() + ": " + error.what();
    // That is no property of the case: a machine without room would fail all that are left.
    if (!hasRoom(scratch.path())) return pack({hasNoRoom, why});
    throw InputError(why);
  }
  return pack(filesIn(scratch.path() / nameOfCase(number)));
}

void takeCase(const std::string& out, std::size_t number, const std::string& bytes) {
  const fs::path folder = fs::path(out) / nameOfCase(number), part = fs::path(out) / ("." + nameOfCase(number));
  std::error_code error;
  fs::remove_all(part, error);
  const Parts files = unpack(bytes);
  if (files.size() == 2 && files[0] == hasNoRoom)
    throw InputError(files[1] + "; what is finished is kept: with room there, the same command goes on");
  for (std::size_t i = 1; i + 1 < files.size(); i += 2) {
    const fs::path path = part / files[i];
    fs::create_directories(path.parent_path(), error);
    if (error) throw InputError(path.parent_path().string() + ": the folder cannot be made: " + error.message());
    writeFile(path.string(), files[i + 1]);
  }
  fs::remove_all(folder, error);  // what an interrupted trial left
  fs::rename(part, folder, error);
  if (error) throw InputError(folder.string() + ": cannot be written: " + error.message());
}

}  // namespace btr
