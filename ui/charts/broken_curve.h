#pragma once
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// Adds a curve to a plot that ends where its points are missing for longer than between most of them, and begins anew
/// behind it: a line over a pause would look measured. The stretches share name, colour and place in the legend.
void addBroken(PlotData& plot, const PlotSeries& whole);

}  // namespace btr::ui
