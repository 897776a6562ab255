#include "ui/charts/fitness_chart.h"

#include <QVBoxLayout>
#include <algorithm>

#include "ui/charts/plot_widget.h"

namespace btr::ui {

FitnessChart::FitnessChart(QWidget* parent) : QWidget(parent), plot_(new PlotWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  redraw();
}

void FitnessChart::redraw() { plot_->setData(fitnessPlot(run_, unit_)); }

void FitnessChart::setUnit(const QString& unit) {
  unit_ = unit;
  redraw();
}

void FitnessChart::setRun(FitnessRun run) {
  if (run.run != run_.run) plot_->resetZoom();
  run_ = std::move(run);
  redraw();
}

void FitnessChart::setHidden(const std::set<double>& fitness) {
  if (run_.hidden == fitness) return;
  run_.hidden = fitness;
  redraw();
}

void FitnessChart::append(const std::vector<GenerationRecord>& generations) {
  for (const GenerationRecord& generation : generations) insert(generation);
  redraw();
}

void FitnessChart::insert(const GenerationRecord& generation) {
  if (generation.run != run_.run) return;
  auto& all = run_.generations;
  const auto place = std::lower_bound(all.begin(), all.end(), generation.number,
                                      [](const GenerationRecord& g, int number) { return g.number < number; });
  // The curves need neither individuals nor learner states.
  GenerationRecord kept = generation;
  kept.individuals.clear();
  kept.randomState.clear();
  kept.learnerState.clear();
  if (place != all.end() && place->number == generation.number)
    *place = std::move(kept);
  else
    all.insert(place, std::move(kept));
}

void FitnessChart::setGenerations(const std::vector<GenerationRecord>& generations) {
  run_.generations = generations;
  redraw();
}

void FitnessChart::setSimulators(const std::vector<SimulatorRecord>& simulators) {
  run_.simulators = simulators;
  redraw();
}

void FitnessChart::setMeasurements(const std::vector<IndividualRecord>& individuals,
                                   const std::vector<MeasurementRecord>& measurements) {
  run_.measuredIndividuals = individuals;
  run_.measurements = measurements;
  redraw();
}

}  // namespace btr::ui
