#pragma once
#include <sys/resource.h>

#include <QProcess>
#include <thread>

namespace btr::ui {

inline constexpr int giveWayNiceness = 10;

/// Learning and analyses take all processors: what the window starts for these lets the window and other programs go
/// first, so that it answers while they are at work.
inline void giveWay(QProcess& process) {
  process.setChildProcessModifier([] { setpriority(PRIO_PROCESS, 0, giveWayNiceness); });
}

/// The same for one that is started detached, where Qt calls no modifier: on Linux niceness is that of a thread and is
/// inherited, so the process is started by one that gives way and then ends.
inline bool startDetachedGivingWay(QProcess& process, qint64* pid) {
  bool started = false;
  std::thread([&] {
    setpriority(PRIO_PROCESS, 0, giveWayNiceness);
    started = process.startDetached(pid);
  }).join();
  return started;
}

}  // namespace btr::ui
