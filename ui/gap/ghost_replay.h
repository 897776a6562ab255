#pragma once
#include <optional>

#include "core/gap/search/gap_report.h"
#include "core/sim/scene.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {

/// The scene that a report was made with. `problem` says in a sentence why it cannot be shown; empty if it can.
struct ReportScene {
  SceneSpec scene;
  ModelSet models;
  QString problem;
};
/// Reads the file that the report's provenance names, if it is still the same.
ReportScene sceneOf(const GapReport& report);

/// A trial of a report in 3D: the body as it was recorded, and as ghosts the body of the simulator as given (orange)
/// and repaired (blue). Made from the report's curves: joints that were not recorded stand at 0. Nothing if the scene's
/// first robot and balls have no curve in the report. Where a value is not known the last known one is held.
struct GhostTrial {
  ReplayData recorded;
  std::vector<GhostReplay> ghosts;
};
std::optional<GhostTrial> ghostTrial(const GapReport& report, std::size_t trial, const SceneSpec& scene,
                                     const ModelSet& models);

}  // namespace btr::ui
