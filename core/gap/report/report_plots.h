#pragma once
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"

/// The vector plots of report.html. Each is one <svg> without a style of its own; pageStyle() of the page has their
/// classes. "" where the report has nothing to draw.
namespace btr::plots {

std::string ladder(const GapReport& report);
std::string heatMap(const GapReport& report, const std::vector<std::size_t>& trials);
std::string overlay(const GapReport& report, std::size_t trial, std::size_t series);
std::string regimes(const GapReport::Located& located);
std::string remainder(const GapReport::Remainder& remainder);
std::string nextRecording(const GapReport::NextRecording& next);

}  // namespace btr::plots
