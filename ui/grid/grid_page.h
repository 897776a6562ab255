#pragma once
#include <QWidget>
#include <map>

#include "core/run/grid/grid_kicks.h"
#include "core/run/grid/grid_table.h"
#include "ui/gap/program_process.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;

namespace btr::ui {
class CubeView;
class KickMap;

/// How far a grid is.
struct GridState {
  bool isActive = false, isFinished = true;
  int done = 0, total = 0;  ///< generations of all cells that learn
};

/// The whole kick: the cells of a grid, the kicks between them, and a map of where these lose something. It reads no
/// database: the grids are given to it; maps are computed by btr beside the window.
class GridPage : public QWidget {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit GridPage(const QString& program = {}, QWidget* parent = nullptr);

  /// What there is to choose from; the chosen one stays.
  void setGrids(const QString& database, const std::vector<GridSummary>& grids);
  void setStates(const std::map<Id, GridState>& states);
  static QString nameOf(const GridRecord& grid);  ///< for lists: what it learns, how, and its seed
  Id current() const;
  void choose(Id grid);

  CubeView& cube() { return *cube_; }
  KickMap& map() { return *map_; }
  /// The point that is previewed: distance [m], bearing and direction [rad], inside the grid.
  std::array<double, 3> point() const;
  void setPoint(const std::array<double, 3>& point);
  void computeMap();
  void cancelMap() { process_.cancel(); }
  bool isComputing() const { return process_.isRunning(); }

 signals:
  void replayRequested(btr::Id run, btr::Id individual);
  void kickRequested(btr::Id grid, double distance_m, double bearing_rad, double direction_rad);
  void newRequested();
  void continueRequested(btr::Id grid);
  void stopRequested(btr::Id grid);
  void mapDone();
  void failed(const QString& message);

 private:
  QWidget* makeTop();
  QWidget* makePreview();
  QWidget* makeMapBar();
  const GridSummary* summary() const;
  void showGrid();
  void showState();
  void showPoint();
  void replayCell(int cell);
  void play();

  ProgramProcess process_;
  QString database_;
  std::vector<GridSummary> grids_;
  std::map<std::pair<Id, double>, GridMap> maps_;  ///< computed ones, by grid and distance
  std::pair<Id, double> computing_{};
  std::map<Id, GridState> states_;
  QComboBox *grid_, *slice_, *shown_;
  QLabel *summary_, *cell_;
  CubeView* cube_;
  KickMap* map_;
  QDoubleSpinBox *distance_, *bearing_, *direction_;
  QSpinBox* steps_;
  QPushButton *play_, *replay_, *compute_, *new_, *go_;
  QProgressBar *progress_, *learned_;
};

}  // namespace btr::ui
