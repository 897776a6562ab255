// A case on disk: what an analyst gets.
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/prove/blind_case.h"

namespace btr::prove {
namespace {

void write(const std::string& folder, const std::string& name, const std::string& text) {
  writeFile((std::filesystem::path(folder) / name).string(), text);
}

/// Makes the folder where it is absent.
void writeTrials(const std::string& folder, const std::vector<std::string>& texts) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder)) throw InputError(folder + ": the folder cannot be made");
  for (std::size_t i = 0; i < texts.size(); ++i) write(folder, "trial_" + std::to_string(i + 1) + ".csv", texts[i]);
}

}  // namespace

void writeCase(const BlindCase& blind, const Hideable& library, const std::string& folder) {
  writeTrials(folder, recordTrials(blind, library));
  for (const auto& [name, text] : blind.world.files) write(folder, name, text);
  write(folder, "scene.json", toJsonText(blind.world.scene));
}

void writeFresh(const BlindCase& blind, const Hideable& library, const std::string& folder) {
  writeTrials(folder, recordFresh(blind, library));
}

}  // namespace btr::prove
