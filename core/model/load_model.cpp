#include "core/model/load_model.h"

#include <filesystem>

#include "core/model/vrml_parser.h"
#include "core/model/vrml_robot.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

RobotModel readVrml(const std::string& text, const std::string& place, const std::string& path,
                    const vrml::InlineFolder* folder, const ModelBudget& budget) {
  vrml::Document document;
  vrml::Spent spent;
  document.roots = vrml::Parser(document, budget, spent, folder).readFile(text, place, path);
  RobotModel model = vrml::extractRobot(document, budget);
  checkModel(model, place);
  return model;
}

std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

}  // namespace

RobotModel parseVrml(const std::string& text, const std::string& place, const ModelBudget& budget) {
  return readVrml(text, place, "", nullptr, budget);
}

RobotModel loadModel(const std::string& path, const ModelBudget& budget) {
  const std::string ending = endingOf(path);
  if (ending != ".wrl" && ending != ".urdf")
    throw InputError(path, "a file ending in \"" + ending + "\"", "robots are .wrl (VRML97) or .urdf files");
  const std::string text = readFile(path, budget.bytes);
  if (ending == ".urdf") return parseUrdf(text, path, budget);
  const vrml::InlineFolder folder(path);
  return readVrml(text, path, vrml::canonicalPath(path), &folder, budget);
}

}  // namespace btr
