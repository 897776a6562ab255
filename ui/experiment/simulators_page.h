#pragma once
#include <QWidget>
#include <vector>

#include "core/store/records.h"

class QLabel;
class QTableWidget;

namespace btr::ui {

/// The lineage of a run's or rig's simulator: every version, who made it, the gap before and after, and for the chosen
/// one each number beside its parent's, with what changed in bold.
class SimulatorsPage : public QWidget {
  Q_OBJECT
 public:
  explicit SimulatorsPage(QWidget* parent = nullptr);
  /// Keeps the chosen version if it is still there, else chooses the newest.
  void setSimulators(const std::vector<SimulatorRecord>& simulators);
  void setGaps(const std::vector<GapRecord>& gaps);
  void setUnit(const QString& unit);
  void select(Id simulator);
  void clear();

 private:
  void showVersions();
  void showDifference();
  const SimulatorRecord* chosen() const;
  const SimulatorRecord* byId(Id id) const;

  std::vector<SimulatorRecord> simulators_;
  std::vector<GapRecord> gaps_;
  QString unit_;
  QTableWidget *versions_, *difference_;
  QLabel *title_, *effects_;
};

}  // namespace btr::ui
