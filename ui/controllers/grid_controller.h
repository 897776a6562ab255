#pragma once
#include <QObject>
#include <QTimer>
#include <vector>

#include "ui/controllers/workbench.h"

namespace btr {
struct GridSummary;
}
namespace btr::ui {
class GridForm;
class GridPage;
struct GridState;
class RunController;
struct RunGroup;

/// The whole kick: its page is filled from the database that is open; grids are described, learned in a process of
/// their own, and stopped.
class GridController : public QObject {
  Q_OBJECT
 public:
  GridController(Workbench& bench, RunController& runs, GridPage& page);
  void read();
  void show(Id grid);
  /// The runs of each grid's cells, for the tree.
  std::vector<RunGroup> groups() const;

 signals:
  void kickWanted(btr::Id grid, double distance_m, double bearing_rad, double direction_rad);

 private:
  GridState stateOf(const GridSummary& grid, bool isFinished) const;
  void describe();
  void start(const GridForm& form);
  void stop(Id grid);
  void watch();
  void checkProcess();
  bool isLearning();  ///< says so, too

  Workbench& bench_;
  RunController& runs_;
  GridPage& page_;
  QTimer process_;         ///< runs while ours may end
  Id wanted_ = 0;          ///< the grid to show when it is read
  bool launched_ = false;  ///< a process of ours whose end was not seen yet
};

}  // namespace btr::ui
