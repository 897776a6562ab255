#include "core/run/setup/reality_settings.h"

#include <unistd.h>

#include <filesystem>

#include "core/spec/error.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// A path setting as a full path, looked at.
std::string pathOf(const TextSetting& setting, const std::string& given, const std::string& directory, bool mustExist,
                   const std::string& place) {
  const std::string path = fs::absolute(fs::path(directory) / given).lexically_normal().string();
  if (!mustExist) return path;
  if (setting.kind == TextSetting::Kind::folder && !fs::is_directory(path))
    throw InputError(place, path, "a folder that exists");
  if (setting.kind == TextSetting::Kind::program && (!fs::is_regular_file(path) || access(path.c_str(), X_OK) != 0))
    throw InputError(place, path, "a file that can be started");
  return path;
}

}  // namespace

void settleReality(PreparedExperiment& prepared, const PluginHost& host, bool mustExist) {
  prepared.reality = host.reality(prepared.spec.reality);
  const std::string place = "experiment /reality/settings";
  const std::vector<Parameter> declared = prepared.reality->settings();
  PluginChoice numbers{prepared.spec.reality, prepared.spec.realityOptions.settings,
                       prepared.spec.realityOptions.words};
  RealityOptions settled;
  for (const TextSetting& setting : prepared.reality->texts()) {
    const auto given = numbers.words.find(setting.name);
    if (given == numbers.words.end() || given->second.empty()) {
      if (setting.required) throw InputError(place + "/" + setting.name, "nothing", setting.meaning);
      continue;
    }
    const std::string& text = given->second;
    settled.words[setting.name] =
        setting.kind == TextSetting::Kind::text
            ? text
            : pathOf(setting, text, prepared.spec.directory, mustExist, place + "/" + setting.name);
    numbers.words.erase(given);
  }
  settled.settings = settingsOf(numbers, declared, place);
  prepared.spec.realityOptions = settled;
  PluginChoice inWords = choiceOf(prepared.spec.reality, settled.settings, declared);
  settled.settings = std::move(inWords.settings);
  settled.words.merge(inWords.words);
  prepared.specInWords.realityOptions = std::move(settled);
}

}  // namespace btr
