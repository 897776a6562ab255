#pragma once
#include <sys/resource.h>

#include <QProcess>

namespace btr::ui {

/// Learning and analyses take all processors: what the window starts for these lets the window and other programs go
/// first, so that it answers while they are at work.
inline void giveWay(QProcess& process) {
  constexpr int niceness = 10;
  process.setChildProcessModifier([] { setpriority(PRIO_PROCESS, 0, niceness); });
}

}  // namespace btr::ui
