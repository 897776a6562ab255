#include "core/openr/robot_starter.h"

#include "core/openr/robot_process.h"

namespace btr::openr {
namespace {

/// A process as whoever asks programs sees it.
class Process final : public RunningProgram {
 public:
  explicit Process(const RobotProcess::Options& options) : process_(options) {}
  OrderFrame exchange(const SensorFrame& frame) override { return process_.exchange(frame); }

 private:
  RobotProcess process_;
};

}  // namespace

std::unique_ptr<RunningProgram> startRobot(const std::string& stick, const RobotDesign& design) {
  RobotProcess::Options options;
  options.stick = stick;
  options.design = design.name;
  return std::make_unique<Process>(options);
}

}  // namespace btr::openr
