#pragma once
#include <memory>

#include "core/plugin/plugin_host.h"
#include "core/run/prepared_experiment.h"

namespace btr {

class RunContext;

/// The experiment's reality plugin and its settings, checked: numbers and choices into `spec`, the same with words into
/// `specInWords`, paths absolute in both. With `mustExist` a program or folder that is not there is refused. Throws
/// InputError.
void settleReality(PreparedExperiment& prepared, const PluginHost& host, bool mustExist);

/// Opens the robot of a run; nullptr where nobody answers but people. Throws InputError.
std::unique_ptr<RealRobot> openRobot(RunContext& context);

}  // namespace btr
