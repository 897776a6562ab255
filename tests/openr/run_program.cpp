#include "tests/openr/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace btr::openr {
namespace {

namespace fs = std::filesystem;

std::string root() {
  static const std::string made = [] {
    const std::string folder = (fs::temp_directory_path() / ("test_openr_" + std::to_string(getpid()))).string();
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
  }();
  return made;
}

/// Removes what the tests made.
class Cleaning : public testing::Environment {
  void TearDown() override { fs::remove_all(root()); }
};
const auto* cleaning = testing::AddGlobalTestEnvironment(new Cleaning);

}  // namespace

std::string emptyFolder(const std::string& name) {
  const std::string folder = root() + "/" + name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void writeText(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

StickBuild buildOnto(const std::string& out, const std::vector<std::string>& folders) {
  fs::remove_all(out);
  StickBuildOptions options;
  options.folders = folders;
  options.out = out;
  return buildStick(options);
}

std::string programFolder(const std::string& program) { return SOURCE_DIR "/tests/openr/programs/" + program; }

std::string stickOf(const std::string& program) {
  static std::map<std::string, std::string> built;
  if (built.count(program) == 0) {
    const std::string out = emptyFolder("built_" + program);
    const StickBuild build = buildOnto(out, {programFolder(program)});
    for (const auto& object : build.objects)
      EXPECT_EQ(object.modules.size(), 1u) << object.folder << "\n" << object.said;
    EXPECT_TRUE(build.absent.empty());
    built[program] = out;
  }
  const std::string copy = emptyFolder("stick_" + program);
  fs::copy(built[program], copy, fs::copy_options::recursive);
  return copy;
}

std::string StickRun::all() const {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::vector<std::int32_t> StickRun::targets(const RobotDesign& design, const std::string& joint) const {
  std::vector<std::int32_t> found;
  for (const OrderFrame& frame : orders)
    for (std::size_t i = 0; i < frame.joints.size(); ++i)
      if (design.joints[i].name == joint && frame.joints[i].target_urad) found.push_back(*frame.joints[i].target_urad);
  return found;
}

StickRun runStick(const std::string& stick, int frames, const std::function<void(int, TrivialRobot&)>& before,
                  const std::string& design, int methodLimit_s) {
  RobotProcess::Options options;
  options.stick = stick;
  options.design = design;
  options.methodLimit_s = methodLimit_s;
  TrivialRobot robot(robotDesign(design));
  RobotProcess program(options);
  StickRun run;
  for (int frame = 1; frame <= frames && !program.ended(); ++frame) {
    if (before) before(frame, robot);
    robot.shutdown = frame == frames;
    run.orders.push_back(program.exchange(robot.sense()));
    robot.obey(run.orders.back());
    for (const ConsoleLine& line : run.orders.back().lines) run.lines.push_back(line.object + ": " + line.text);
  }
  if (program.ended()) run.ended = *program.ended();
  return run;
}

}  // namespace btr::openr
