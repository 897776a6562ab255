// Colour stages from photographs and what a camera without errors sees in their place.
#include <ceres/ceres.h>

#include "core/camera/calibration/colour_model.h"
#include "core/camera/calibration/held_out.h"
#include "core/camera/camera_pipeline.h"
#include "core/camera/twin.h"
#include "core/spec/error.h"

namespace btr {
namespace {

constexpr std::array<const char*, colourNumberCount> colourNames{
    "colour/red_gain", "colour/green_gain", "colour/blue_gain", "vignetting/r2",  "vignetting/r4", "vignetting/r6",
    "colour/red_r2",   "colour/red_r4",     "colour/blue_r2",   "colour/blue_r4", "gamma/gamma"};
constexpr double darkest = 12 / 255.0, brightest = 243 / 255.0;  // beyond, noise is cut off
constexpr double mostUncertainGamma = 0.2;
constexpr std::size_t fewestPixels = 300;

using Samples = std::vector<ColourSample>;

struct ColourResidual {
  ColourSample sample;
  double bias;  ///< of the mean of a curved code, from noise

  template <class T>
  bool operator()(const T* numbers, T* residual) const {
    residual[0] = 255.0 * (codeOf(sample, numbers) + bias - sample.code);
    return true;
  }
};

struct ColourFit {
  ColourNumbers value{}, deviation{};
  std::array<bool, colourNumberCount> free{};
};

/// Pixels of which all three channels are well within black and white, as far as the numbers foretell.
Samples usable(const Samples& all, const ColourNumbers& n) {
  Samples kept;
  for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const double code = codeOf(all[i + c], n.data());
      inside = inside && code > darkest && code < brightest;
    }
    if (inside) kept.insert(kept.end(), all.begin() + static_cast<long>(i), all.begin() + static_cast<long>(i) + 3);
  }
  return kept;
}

/// Before anything is fitted only the photograph tells what is too dark or too bright.
Samples usableAsSeen(const Samples& all) {
  Samples kept;
  for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c)
      inside = inside && all[i + c].code > darkest && all[i + c].code < brightest && all[i + c].light > 0;
    if (inside) kept.insert(kept.end(), all.begin() + static_cast<long>(i), all.begin() + static_cast<long>(i) + 3);
  }
  return kept;
}

// Second order: half the curvature of the code times the variance of the signal.
double biasOf(const ColourSample& sample, const ColourNumbers& n, const NoiseFit& noise) {
  const double signal = signalOf(sample, n.data()), power = 1 / n[gammaPower];
  if (!(signal > 0)) return 0;
  const double variance = noise.read * noise.read + noise.shot * signal;
  return 0.5 * power * (power - 1) * std::pow(signal, power - 2) * variance;
}

void checkEnough(const Samples& samples) {
  if (samples.size() / 3 < fewestPixels)
    throw InputError("photographs", std::to_string(samples.size() / 3) + " usable pixels",
                     "at least " + std::to_string(fewestPixels) + " that are even, and neither black nor white");
}

void addColourDeviations(ceres::Problem& problem, ColourFit& fit, double variance) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = 0;
  ceres::Covariance covariance(options);
  const std::vector<std::pair<const double*, const double*>> block{{fit.value.data(), fit.value.data()}};
  if (!covariance.Compute(block, &problem))
    throw InputError("photographs", "these", "different brightnesses and colours all over the picture");
  std::array<double, colourNumberCount * colourNumberCount> all{};
  covariance.GetCovarianceBlock(fit.value.data(), fit.value.data(), all.data());
  for (std::size_t i = 0; i < colourNumberCount; ++i)
    fit.deviation[i] = fit.free[i] ? std::sqrt(std::max(0.0, all[i * (colourNumberCount + 1)]) * variance) : 0;
}

/// One least-squares fit of the free numbers.
void solveColour(const Samples& samples, const NoiseFit& noise, ColourFit& fit) {
  checkEnough(samples);
  ceres::Problem problem;
  for (const ColourSample& sample : samples) {
    auto* cost = new ceres::AutoDiffCostFunction<ColourResidual, 1, colourNumberCount>(
        new ColourResidual{sample, biasOf(sample, fit.value, noise)});
    problem.AddResidualBlock(cost, nullptr, fit.value.data());
  }
  std::vector<int> constant;
  for (std::size_t i = 0; i < colourNumberCount; ++i)
    if (!fit.free[i]) constant.push_back(static_cast<int>(i));
  if (!constant.empty()) problem.SetManifold(fit.value.data(), new ceres::SubsetManifold(colourNumberCount, constant));
  problem.SetParameterLowerBound(fit.value.data(), gammaPower, 0.2);
  problem.SetParameterUpperBound(fit.value.data(), gammaPower, 5);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const double freedom = static_cast<double>(samples.size()) - static_cast<double>(colourNumberCount - constant.size());
  addColourDeviations(problem, fit, 2 * summary.final_cost / freedom);
}

/// Gives up the highest term of a polynomial that is not told from 0, or gamma; false if all are told.
bool giveUpOneColour(ColourFit& fit, ColourNumbers& dropped, const ColourNumbers& given) {
  const auto giveUp = [&](std::size_t number, double value) {
    dropped[number] = fit.deviation[number];
    fit.free[number] = false;
    fit.value[number] = value;
    return true;
  };
  if (fit.free[gammaPower] && fit.deviation[gammaPower] > mostUncertainGamma)
    return giveUp(gammaPower, given[gammaPower]);
  const std::vector<std::vector<std::size_t>> polynomials{
      {rim6, rim4, rim2}, {redCast4, redCast2}, {blueCast4, blueCast2}};
  for (const auto& polynomial : polynomials)
    for (const std::size_t term : polynomial) {
      if (!fit.free[term]) continue;
      if (std::abs(fit.value[term]) < identifiedDeviations * fit.deviation[term]) return giveUp(term, 0);
      break;
    }
  return false;
}

double codeError(const Samples& samples, const ColourNumbers& n) {
  double square = 0;
  for (const ColourSample& sample : samples) square += std::pow(255 * (codeOf(sample, n.data()) - sample.code), 2);
  return samples.empty() ? 0 : std::sqrt(square / static_cast<double>(samples.size()));
}

void checkColourViews(const CameraSpec& spec, std::span<const ColourView> views) {
  if (views.size() < 2)
    throw InputError("photographs", std::to_string(views.size()), "at least 2, each with its rendering");
  const Pinhole wanted = CameraPipeline(spec).pinhole();
  const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
  for (const ColourView& view : views) {
    if (view.photo.width != spec.width || view.photo.height != spec.height)
      throw InputError(view.name, size(view.photo.width, view.photo.height) + " pixels",
                       "the sensor's " + size(spec.width, spec.height));
    if (view.scene.pinhole.width != wanted.width || view.scene.pinhole.height != wanted.height ||
        view.scene.rgb.size() != 3 * static_cast<std::size_t>(wanted.width) * static_cast<std::size_t>(wanted.height))
      throw InputError(view.name, "a rendering of " + size(view.scene.pinhole.width, view.scene.pinhole.height),
                       size(wanted.width, wanted.height) + " pixels, as this camera's lens wants it");
  }
}

}  // namespace

CameraTwin fitColour(const CameraSpec& spec, std::span<const ColourView> views, const TwinOptions& options) {
  checkColourViews(spec, views);
  const std::vector<bool> held = heldOutPhotos(views.size(), options);
  std::vector<Samples> all;
  Samples fitted;
  for (std::size_t i = 0; i < views.size(); ++i) {
    all.push_back(colourSamples(spec, views[i]));
    if (!held[i]) fitted.insert(fitted.end(), all.back().begin(), all.back().end());
  }

  // First what the photograph calls neither black nor white; then what the numbers say, which does not choose by noise.
  const ColourNumbers given = colourNumbersOf(spec);
  ColourFit fit;
  fit.value = given;
  fit.free.fill(true);
  NoiseFit noise;
  ColourNumbers dropped{};
  solveColour(usableAsSeen(fitted), noise, fit);
  noise = fitNoise(usable(fitted, fit.value), fit.value);
  solveColour(usable(fitted, fit.value), noise, fit);
  while (giveUpOneColour(fit, dropped, given)) solveColour(usable(fitted, fit.value), noise, fit);
  noise = fitNoise(usable(fitted, fit.value), fit.value);

  CameraTwin twin;
  twin.spec = withColourNumbers(spec, fit.value);
  twin.spec[CameraStage::noise] = {
      true, {{"gain_db", 0}, {"read", noise.read}, {"shot", noise.shot}, {"pattern_offset", 0}, {"pattern_gain", 0}}};
  check(twin.spec, spec.name);
  for (std::size_t i = 0; i < colourNumberCount; ++i)
    twin.numbers.push_back(
        {colourNames[i], "", given[i], fit.value[i], fit.free[i] ? fit.deviation[i] : dropped[i], fit.free[i]});
  const auto noiseBefore = [&](const char* name) {
    return spec[CameraStage::noise].on ? spec.number(CameraStage::noise, name) : 0;
  };
  twin.numbers.push_back({"noise/read", "", noiseBefore("read"), noise.read, noise.readDeviation, true});
  twin.numbers.push_back({"noise/shot", "", noiseBefore("shot"), noise.shot, noise.shotDeviation, true});
  Samples unseen;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Samples judged = usable(all[i], fit.value);
    twin.photos.push_back({views[i].name, held[i], codeError(judged, given), codeError(judged, fit.value)});
    if (held[i]) unseen.insert(unseen.end(), judged.begin(), judged.end());
  }
  twin.heldOutBefore = rootMeanSquare(twin.photos, true, true);
  twin.heldOutAfter = rootMeanSquare(twin.photos, true, false);
  twin.fittedAfter = rootMeanSquare(twin.photos, false, false);
  twin.noise = noiseLevel(unseen, fit.value, noise);
  return twin;
}

}  // namespace btr
