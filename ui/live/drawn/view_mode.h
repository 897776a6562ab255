#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ui/live/drawn/live_scene.h"
#include "ui/scene3d/view_camera.h"

namespace btr::ui {

/// How a view's camera goes with the world.
enum class ViewMode {
  free,    ///< it stays where the mouse puts it
  follow,  ///< it keeps an object in its middle and turns with nobody
  aboard,  ///< it looks over an object's shoulder and turns with it
  top,     ///< it looks straight down, on an object or on the world's middle
};
inline constexpr int kViewModes = 4;
const char* nameOf(ViewMode mode);

/// The camera for a row. An object that is not there leaves it where it is.
ViewCamera cameraFor(ViewMode mode, const std::string& object, ViewCamera camera, const LiveScene& scene,
                     const LiveRow& row);

nlohmann::json toJson(const ViewCamera& camera);
/// What is absent or no number stays as by default, and all is brought into its bounds.
ViewCamera viewCameraFrom(const nlohmann::json& object);

}  // namespace btr::ui
