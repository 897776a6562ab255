// A case on disk: what an analyst gets.
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/prove/blind_case.h"

namespace btr::prove {

void writeCase(const BlindCase& blind, const Hideable& library, const std::string& folder) {
  const auto texts = recordTrials(blind, library);
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder)) throw InputError(folder + ": the folder cannot be made");
  const auto write = [&](const std::string& name, const std::string& text) {
    writeFile((std::filesystem::path(folder) / name).string(), text);
  };
  for (const auto& [name, text] : blind.world.files) write(name, text);
  for (std::size_t i = 0; i < texts.size(); ++i) write("trial_" + std::to_string(i + 1) + ".csv", texts[i]);
  write("scene.json", toJsonText(blind.world.scene));
}

}  // namespace btr::prove
