#include "core/run/reality/rig.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {

Rig loadRig(const std::string& path) {
  namespace fs = std::filesystem;
  Rig rig{fs::path(path).stem().string(), "", loadScene(path)};
  SceneSpec scene = rig.scene;  // without places of files
  nlohmann::json models = nlohmann::json::object();
  for (RobotSpec& robot : scene.robots) {
    const std::string content = readFile((fs::path(scene.directory) / robot.model).string());
    // Two models may have the same name in different folders: the hash tells them apart.
    const std::string name = fs::path(robot.model).filename().string();
    models[robot.name] = {{"model", name}, {"sha256", sha256(content)}};
    robot.model = name;
  }
  const nlohmann::json spec{
      {"format", "uchilsim-rig-1"}, {"scene", nlohmann::json::parse(toJsonText(scene))}, {"models", std::move(models)}};
  rig.spec = spec.dump();
  return rig;
}

std::optional<Id> findRig(const Database& database, const Rig& rig) { return database.findExperiment(rig.spec); }

Id requireRig(const Database& database, const std::string& scene) {
  if (const auto id = findRig(database, loadRig(scene))) return *id;
  throw InputError(scene + ": " + database.path() +
                   " has nothing of this rig; adopt a simulator for it or keep recordings of it first");
}

Id addRig(Database& database, const Rig& rig) {
  SimulatorRecord asGiven;
  asGiven.madeBy = "start";
  asGiven.evidence = "{}";
  return database.addRig({0, rig.name, rig.spec, "", ""}, asGiven);
}

}  // namespace btr
