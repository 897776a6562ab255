#pragma once
#include <vector>

#include "core/run/comparison.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// Reality gap and real fitness of several arms by measurement stage in one chart: for each arm its mean gap on
/// individuals that no update had seen, and the mean real fitness of the measured individuals, both with 95 % intervals
/// over the seeds. `note` says where real fitness came from.
PlotData stagePlot(const std::vector<ComparedArm>& arms, const QString& unit, const QString& note);

}  // namespace btr::ui
