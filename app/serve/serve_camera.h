#pragma once
#include "core/remote/camera_eye.h"

namespace btr::cli {

/// Cameras of robots by btr-camera, beside this program; none where it was not built.
remote::CameraMaker cameraMaker();

}  // namespace btr::cli
