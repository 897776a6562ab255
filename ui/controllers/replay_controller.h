#pragma once
#include <QObject>
#include <functional>
#include <memory>
#include <utility>

#include "ui/controllers/workbench.h"

namespace btr {
struct GapReport;
}
namespace btr::ui {
class GapPage;
class IndividualsTable;
struct ReplayData;
class ReplayJob;
class ReplayPanel;

/// What the 3D view shows: an individual's trial made again, a kick between a grid's cells, a report's trial with its
/// ghosts. Trials are simulated in a thread of their own, from a connection of their own.
class ReplayController : public QObject {
  Q_OBJECT
 public:
  ReplayController(Workbench& bench, ReplayPanel& panel, IndividualsTable& individuals, GapPage& reports);
  void replay(Id individual);
  void replayPair(Id first, Id second);  ///< side by side
  void replayBest();                     ///< of the last generation
  void playKick(Id grid, double distance_m, double bearing_rad, double direction_rad);

 private:
  std::function<ReplayData(Id)> replayer() const;  ///< for another thread
  void showGhosts(std::size_t trial, double time_s);

  Workbench& bench_;
  ReplayPanel& panel_;
  IndividualsTable& individuals_;
  GapPage& reports_;
  ReplayJob* job_;
  std::pair<std::shared_ptr<const GapReport>, std::size_t> ghosts_;  ///< report and trial that the view shows
};

}  // namespace btr::ui
