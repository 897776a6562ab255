#pragma once
#include "core/plugin/plugin_host.h"
#include "core/run/setup/prepared_experiment.h"

namespace btr {

/// The experiment's reality plugin and its settings, checked: numbers and choices into `spec`, the same with words into
/// `specInWords`, paths absolute in both. With `mustExist` a program or folder that is not there is refused. Throws
/// InputError.
void settleReality(PreparedExperiment& prepared, const PluginHost& host, bool mustExist);

}  // namespace btr
