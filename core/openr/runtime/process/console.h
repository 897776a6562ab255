#pragma once

namespace btr::openr {

struct RunningObject;

/// Standard streams of the object's own: what it reads is typed on the robot's console, what it writes stands there
/// under its name.
void openConsole(RunningObject& object);
/// C++ streams, once for all objects.
void openStreams();

}  // namespace btr::openr
