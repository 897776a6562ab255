#pragma once

class QMainWindow;
class QString;

namespace btr {
class PluginHost;
}
namespace btr::ui {
class Alarm;
class ComparePage;
class DockLayout;
class ExperimentForm;
class ExperimentTree;
class FitnessChart;
class GapChart;
class GapPage;
class GridPage;
class IndividualsTable;
class LivePage;
class MeasurementSheet;
class PolicyPage;
class ReplayPanel;
class RunPanel;
class SimulatorsPage;
class StartPage;

/// What stands in the window's docks; owned by them.
struct WindowPages {
  ExperimentTree* tree = nullptr;
  ExperimentForm *draft = nullptr, *spec = nullptr;
  RunPanel* panel = nullptr;
  FitnessChart* fitness = nullptr;
  GapChart* gap = nullptr;
  SimulatorsPage* versions = nullptr;
  IndividualsTable* individuals = nullptr;
  MeasurementSheet* sheet = nullptr;
  PolicyPage* policies = nullptr;
  ReplayPanel* replay = nullptr;
  GapPage* gapPage = nullptr;
  GridPage* gridPage = nullptr;
  LivePage* livePage = nullptr;
  ComparePage* comparePage = nullptr;
  StartPage* start = nullptr;
  Alarm* alarm = nullptr;
};

/// Makes them all, in docks of the window. `program` is btr, `settingsFile` the alarm's.
WindowPages makePages(QMainWindow& window, DockLayout& layout, const PluginHost& host, const QString& program,
                      const QString& settingsFile);

}  // namespace btr::ui
