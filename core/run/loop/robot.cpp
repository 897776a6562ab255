#include "core/run/loop/robot.h"

#include <cstdlib>
#include <filesystem>

#include "core/run/loop/run_context.h"
#include "core/spec/error.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// Who plays a stand-in: $UCHILSIM_BTR, else "btr" beside the running program; with "played_by": "program" the one that
/// $UCHILSIM_STAND_IN names. Throws InputError if that is not set.
std::string standInProgram(const ExperimentSpec& spec) {
  const char* btr = std::getenv("UCHILSIM_BTR");
  const char* named = std::getenv("UCHILSIM_STAND_IN");
  if (valueOf(standInParameters(), spec.standIn, "played_by") == 1) {
    if (named && *named) return named;
    throw InputError("experiment /stand_in/played_by", "program",
                     "the environment variable UCHILSIM_STAND_IN to name the program that plays the robot");
  }
  if (btr && *btr) return btr;
  return (fs::read_symlink("/proc/self/exe").parent_path() / "btr").string();
}

}  // namespace

std::unique_ptr<RealRobot> openRobot(RunContext& context) {
  const PreparedExperiment& prepared = context.prepared;
  RealityContext opened;
  opened.database = context.database.path();
  opened.run = context.record.id;
  opened.genotype = prepared.genotype;
  opened.unit = prepared.fitness->unit();
  const std::vector<Parameter> declared = prepared.reality->settings();
  for (const Parameter& p : declared)
    opened.settings[p.name] = valueOf(declared, prepared.spec.realityOptions.settings, p.name);
  opened.texts = prepared.spec.realityOptions.words;
  if (context.record.reality == "stand_in") opened.btr = standInProgram(prepared.spec);
  opened.stopped = [&context] { return context.stopped(); };
  return prepared.reality->open(opened);
}

}  // namespace btr
