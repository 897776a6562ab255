#pragma once
#include "core/live/camera_eye.h"

namespace btr::cli {

/// Cameras of robots by btr-camera, beside this program; none where it was not built.
CameraMaker cameraMaker();

}  // namespace btr::cli
