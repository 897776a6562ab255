#pragma once
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"

/// The vector plots of report.html. Each is one <svg> without a style of its own; pageStyle() of the page has their
/// classes. "" where the report has nothing to draw.
namespace btr::plots {

std::string ladder(const GapReport& report);
std::string heatMap(const GapReport& report, const std::vector<std::size_t>& trials);
/// Recorded and simulated, and the differences below. `calibrated`: with the curve between as given and final.
std::string overlay(const GapReport& report, std::size_t trial, std::size_t series, bool calibrated = true);
/// The way from a command to a measurement, with the links at which effects act marked; of robots, or of a ball.
std::string chain(const std::vector<EffectLaw::Acts>& marked, bool ofBall);
std::string regimes(const GapReport::Located& located);
std::string remainder(const GapReport::Remainder& remainder);
/// A curve of a measured law with its band.
std::string lawCurve(const GapReport::LawCurve& curve, const std::string& at);
std::string nextRecording(const GapReport::NextRecording& next);

}  // namespace btr::plots
