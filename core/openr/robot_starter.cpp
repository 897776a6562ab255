#include "core/openr/robot_starter.h"

#include "core/openr/robot_process.h"

namespace btr::openr {
namespace {

/// A process as whoever asks programs sees it.
class Process final : public RunningProgram {
 public:
  Process(const RobotProcess::Options& options, double patience_s) : process_(options), patience_s_(patience_s) {}
  OrderFrame exchange(const SensorFrame& frame) override { return process_.exchange(frame, patience_s_); }

 private:
  RobotProcess process_;
  const double patience_s_;
};

}  // namespace

std::unique_ptr<RunningProgram> startRobot(const std::string& stick, const RobotDesign& design) {
  return robotStarter(RobotProcess::patience_s)(stick, design);
}

LivePrograms::Starter robotStarter(double patience_s) {
  return [patience_s](const std::string& stick, const RobotDesign& design) -> std::unique_ptr<RunningProgram> {
    RobotProcess::Options options;
    options.stick = stick;
    options.design = design.name;
    return std::make_unique<Process>(options, patience_s);
  };
}

}  // namespace btr::openr
