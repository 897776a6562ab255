#include "core/model/load_model.h"

#include <filesystem>

#include "core/model/servo_by_load.h"
#include "core/model/vrml/vrml_parser.h"
#include "core/model/vrml/vrml_robot.h"
#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/json_reader.h"
#include "core/spec/utf8.h"

namespace btr {
namespace {

RobotModel readVrml(const std::string& text, const std::string& place, const std::string& path,
                    const vrml::InlineFolder* folder, const ModelBudget& budget) {
  vrml::Document document;
  vrml::Spent spent;
  document.roots =
      vrml::Parser(document, budget, spent, folder).readFile(isUtf8(text) ? text : utf8OfLatin1(text), place, path);
  RobotModel model = vrml::extractRobot(document, budget);
  checkModel(model, place);
  chooseServosByLoad(model);
  return model;
}

}  // namespace

RobotModel parseVrml(const std::string& text, const std::string& place, const ModelBudget& budget) {
  return readVrml(text, place, "", nullptr, budget);
}

RobotModel loadModel(const std::string& path, const ModelBudget& budget) {
  const std::string ending = fileEnding(path);
  if (ending == ".xacro")
    throw InputError(path + ": a xacro file must be expanded first (xacro robot.urdf.xacro > robot.urdf)");
  if (ending != ".wrl" && ending != ".urdf")
    throw InputError(path, "a file ending in \"" + ending + "\"", "robots are .wrl (VRML97) or .urdf files");
  const std::string text = readFile(path, budget.bytes);
  if (ending == ".urdf") return parseUrdf(text, path, budget, meshesBeside(path, budget));
  const vrml::InlineFolder folder(path);
  return readVrml(text, path, vrml::canonicalPath(path), &folder, budget);
}

}  // namespace btr
