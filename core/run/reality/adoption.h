#pragma once
#include <optional>
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/run/reality/rig.h"
#include "core/store/database.h"

namespace btr {

/// Makes a simulator the newest version of a run, made by "gap analysis": its values replace those of the version
/// before, values that it does not name stay, its effects are all the effects. What the run learns and adapts from then
/// on is done in it. `evidence` is JSON text, kept with the version. Nothing stored before changes.
/// Throws InputError if a process works on the run, if the run is finished or in the middle of an adaptation (whose
/// candidates would have two different parents), and for a simulator that cannot be built in the run's scene.
SimulatorRecord adoptSimulator(Database& database, const PluginHost& host, Id run, const SimulatorSpec& simulator,
                               const std::string& evidence);

/// The same from files: `simulator` is a simulator.json; with the folder of the report that it comes from, the report's
/// hash, verdict and recordings are the evidence.
SimulatorRecord adoptFromFiles(Database& database, const PluginHost& host, Id run, const std::string& simulator,
                               const std::string& report = "");

/// The same for a rig, which is added to the database where it is not there yet. Refuses a report of another scene, or
/// of this one before its file was changed.
SimulatorRecord adoptForRig(Database& database, const PluginHost& host, const std::string& scene,
                            const std::string& simulator, const std::string& report = "");

/// Makes an earlier version the newest again, as a new version made "by hand": the one with that number, by default the
/// newest version's parent. Throws InputError as above.
SimulatorRecord revertSimulator(Database& database, Id run, std::optional<int> number = {});
/// The same for a rig, by its experiment.
SimulatorRecord revertRig(Database& database, Id rig, std::optional<int> number = {});

/// What a version came from, for people: "L3", "gap analysis", "by hand"; "back to version 0" for a reverting one.
std::string originOf(const SimulatorRecord& version);

}  // namespace btr
