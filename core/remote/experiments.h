#pragma once
#include "core/plugin/plugin_host.h"
#include "core/remote/games_folder.h"
#include "core/spec/experiment_spec.h"

namespace uchilsim::v1 {
class Experiment;
}

namespace btr::remote {

/// The experiment that a client names or sends. One that is sent may neither name folders of plugins nor a reality that
/// starts programs or opens files,
/// nor a controller that does. Throws InputError.
ExperimentSpec experimentOf(const uchilsim::v1::Experiment& message, const GamesFolder& folder, const PluginHost& host);

}  // namespace btr::remote
