#pragma once
#include <QObject>
#include <vector>

#include "ui/controllers/workbench.h"

namespace btr::ui {
class ExperimentForm;
class FitnessChart;
class GapChart;
class IndividualsTable;
class RunPanel;
class SimulatorsPage;

/// From the watcher to the pages that show the selected run: every value goes one way.
class RunViews : public QObject {
  Q_OBJECT
 public:
  struct Pages {
    ExperimentForm& spec;
    RunPanel& panel;
    FitnessChart& fitness;
    GapChart& gap;
    SimulatorsPage& versions;
    IndividualsTable& individuals;
  };
  RunViews(Workbench& bench, const Pages& pages);

 private:
  void clear();
  void select(const RunRecord& run);

  Workbench& bench_;
  Pages pages_;
  std::vector<SimulatorRecord> simulators_;
  std::vector<GapRecord> gaps_;
};

}  // namespace btr::ui
