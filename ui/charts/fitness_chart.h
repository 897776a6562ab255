#pragma once
#include <QWidget>

#include "ui/charts/fitness_plot.h"

namespace btr::ui {

class PlotWidget;

/// The live fitness chart of a run. Takes values; the caller reads the database.
class FitnessChart : public QWidget {
  Q_OBJECT

 public:
  explicit FitnessChart(QWidget* parent = nullptr);

  void setUnit(const QString& unit);
  void setRun(FitnessRun run);
  const FitnessRun& run() const { return run_; }

  /// One more generation, or a newer record of one that is there; those of other runs are ignored.
  void append(const GenerationRecord& generation) { append(std::vector{generation}); }
  void append(const std::vector<GenerationRecord>& generations);
  void setGenerations(const std::vector<GenerationRecord>& generations);
  void setSimulators(const std::vector<SimulatorRecord>& simulators);
  /// `individuals` are those that the measurements name.
  void setMeasurements(const std::vector<IndividualRecord>& individuals,
                       const std::vector<MeasurementRecord>& measurements);

  /// Simulated fitness that nobody shall know yet.
  void setHidden(const std::set<double>& fitness);

  PlotWidget& plot() { return *plot_; }

 private:
  void insert(const GenerationRecord& generation);
  void redraw();

  PlotWidget* plot_;
  QString unit_;
  FitnessRun run_;
};

}  // namespace btr::ui
