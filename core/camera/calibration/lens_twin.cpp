// Which numbers of a lens its photographs tell, and how well they foretell others.
#include "core/camera/calibration/held_out.h"
#include "core/camera/calibration/lens_fit.h"
#include "core/camera/twin.h"
#include "core/spec/error.h"

namespace btr {
namespace {

constexpr std::array<const char*, lensNumberCount> lensNames{"focal_px", "centre_x_px", "centre_y_px", "k1",
                                                             "k2",       "k3",          "p1",          "p2"};
constexpr double mostUncertainShare = 0.05;  // of focal length, or of the picture's width for the centre

using FreeNumbers = std::array<bool, lensNumberCount>;

LensNumbers numbersOf(const CameraSpec& spec) {
  LensNumbers n{spec.focal_px, spec.centreX_px, spec.centreY_px};
  if (spec[CameraStage::lens].on)
    for (std::size_t i = k1; i < lensNumberCount; ++i) n[i] = spec.number(CameraStage::lens, lensNames[i]);
  return n;
}

CameraSpec withNumbers(CameraSpec spec, const LensNumbers& n) {
  spec.focal_px = n[focal];
  spec.centreX_px = n[centreX];
  spec.centreY_px = n[centreY];
  spec[CameraStage::lens].on = true;
  for (std::size_t i = k1; i < lensNumberCount; ++i) spec[CameraStage::lens].values[lensNames[i]] = n[i];
  check(spec, spec.name);
  return spec;
}

void checkView(const CameraSpec& spec, const PointView& view) {
  if (view.points_m.size() != view.seen_px.size() || view.points_m.size() < 12)
    throw InputError(view.name, std::to_string(view.points_m.size()) + " points", "at least 12, each with its pixel");
  for (const auto& p : view.seen_px)
    if (!(p[0] > -1 && p[0] < spec.width && p[1] > -1 && p[1] < spec.height))
      throw InputError(view.name, "a point at " + toText(p[0]) + ", " + toText(p[1]),
                       "pixels within " + std::to_string(spec.width) + "x" + std::to_string(spec.height));
}

void checkViews(const CameraSpec& spec, std::span<const PointView> views) {
  std::size_t posed = 0;
  for (const PointView& view : views) {
    checkView(spec, view);
    posed += view.pose ? 1 : 0;
  }
  if (posed != 0 && posed != views.size())
    throw InputError("photographs", "poses of " + std::to_string(posed) + " of " + std::to_string(views.size()),
                     "poses of all, or of none");
  const std::size_t least = posed ? 2 : 4;
  if (views.size() < least)
    throw InputError("photographs", std::to_string(views.size()) + " that show the points",
                     "at least " + std::to_string(least));
}

/// Which numbers are fitted, where the others stay, and how uncertain those were when they were given up.
struct LensChoice {
  explicit LensChoice(const LensNumbers& given) : start(given) { free.fill(true); }

  void giveUp(std::size_t number, double value, const LensFit& fit) {
    free[number] = false;
    start[number] = value;
    deviation[number] = fit.deviation[number];
  }

  FreeNumbers free{};
  LensNumbers start, deviation{};
};

bool isVague(const LensFit& fit, std::size_t number) {
  return std::abs(fit.value[number]) < identifiedDeviations * fit.deviation[number];
}

/// Gives up one thing that the fit did not tell; false if it told all.
bool giveUpOne(LensChoice& choice, const LensFit& fit, int width, const LensNumbers& given) {
  if (choice.free[focal] && fit.deviation[focal] > mostUncertainShare * fit.value[focal]) {
    choice.giveUp(focal, given[focal], fit);
    return true;
  }
  if (choice.free[centreX] && std::max(fit.deviation[centreX], fit.deviation[centreY]) > mostUncertainShare * width) {
    for (const std::size_t number : {centreX, centreY}) choice.giveUp(number, given[number], fit);
    return true;
  }
  // Radial terms are nearly the same curve: without the highest the others are told well.
  for (const std::size_t radial : {k3, k2, k1}) {
    if (!choice.free[radial]) continue;
    if (!isVague(fit, radial)) break;
    choice.giveUp(radial, 0, fit);
    return true;
  }
  if (choice.free[p1] && isVague(fit, p1) && isVague(fit, p2)) {
    for (const std::size_t number : {p1, p2}) choice.giveUp(number, 0, fit);
    return true;
  }
  return false;
}

}  // namespace

CameraTwin fitLens(const CameraSpec& spec, std::span<const PointView> views, const TwinOptions& options) {
  check(spec, spec.name);
  checkViews(spec, views);
  const std::vector<bool> held = heldOutPhotos(views.size(), options);
  std::vector<PointView> fitted;
  for (std::size_t i = 0; i < views.size(); ++i)
    if (!held[i]) fitted.push_back(views[i]);

  const LensNumbers given = numbersOf(spec);
  LensChoice choice(given);
  LensFit fit = fitLensNumbers(fitted, spec.width, spec.height, choice.start, choice.free);
  while (giveUpOne(choice, fit, spec.width, given))
    fit = fitLensNumbers(fitted, spec.width, spec.height, choice.start, choice.free);

  CameraTwin twin;
  twin.spec = withNumbers(spec, fit.value);
  for (std::size_t i = 0; i < lensNumberCount; ++i)
    twin.numbers.push_back({lensNames[i], i < k1 ? "px" : "", given[i], fit.value[i],
                            choice.free[i] ? fit.deviation[i] : choice.deviation[i], choice.free[i]});
  for (std::size_t i = 0; i < views.size(); ++i)
    twin.photos.push_back({views[i].name, held[i], lensError(views[i], given), lensError(views[i], fit.value)});
  twin.heldOutBefore = rootMeanSquare(twin.photos, true, true);
  twin.heldOutAfter = rootMeanSquare(twin.photos, true, false);
  twin.fittedAfter = rootMeanSquare(twin.photos, false, false);
  return twin;
}

}  // namespace btr
