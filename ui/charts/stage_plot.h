#pragma once
#include "core/run/comparison.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// What is compared by measurement stage: each has an axis of its own.
enum class StageQuantity { gap, realFitness };

/// Gap on unseen individuals, or real fitness, by measurement stage: one series an arm; of several seeds the mean, with
/// the 95 % interval as bars. A fitness of which no value is negative has no interval below 0, nor has a gap.
PlotData stagePlot(const std::vector<ComparedArm>& arms, StageQuantity quantity, const QString& unit,
                   const QString& note);

}  // namespace btr::ui
