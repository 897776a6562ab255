#pragma once
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"

namespace btr {

/// A fitted number's 95 % interval, inside its bounds, in its unit.
GapReport::Interval interval95(const FitModel& model, const Uncertainty& uncertainty, std::size_t parameter);

/// The same of a number of the final model with each effect or one of its listed rivals in its place: from the lowest
/// to the highest end of all these intervals (see GapReport::Number::amongRivals). A payload and an offset of the
/// sensor that explain a recording alike ask for other gains of the servo; the interval of either fit alone knows
/// nothing of that. none() where no rival's model has this number.
GapReport::Interval intervalAmongRivals(const SearchResult& found, std::size_t parameter);

}  // namespace btr
