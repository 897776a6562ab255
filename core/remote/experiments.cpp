#include "core/remote/experiments.h"

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "uchilsim.pb.h"

namespace btr::remote {

ExperimentSpec experimentOf(const uchilsim::v1::Experiment& message, const GamesFolder& folder,
                            const PluginHost& host) {
  if (message.file().empty() == message.json().empty())
    throw InputError("experiment", "both or none of file and json", "one of them");
  if (message.json().empty()) return loadExperiment(folder.file(message.file(), {".json"}, "experiment"));
  const std::string place = "experiment", directory = folder.folder(message.directory(), "directory");
  requireShallow(message.json(), place);
  ExperimentSpec spec = experimentFromJson(message.json(), place, directory);
  if (!spec.plugins.empty()) throw InputError(place + " /plugins", spec.plugins.front(), "none in a text that is sent");
  if (spec.reality != "person" && spec.reality != "stand_in" && spec.reality != "remote")
    throw InputError(place + " /reality", spec.reality, "person, stand_in or remote in a text that is sent");
  if (!host.controller(spec.controller.name)->paths().empty())
    throw InputError(place + " /controller", spec.controller.name, "one without files in a text that is sent");
  folder.requireInside(spec.scene, directory, place + " /scene");
  return spec;
}

}  // namespace btr::remote
