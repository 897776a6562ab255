#include "core/camera/calibration/colour_model.h"

#include <Eigen/Dense>

#include "core/camera/camera_pipeline.h"
#include "core/camera/stages/colour.h"
#include "core/camera/stages/lens.h"
#include "core/camera/stages/rim.h"
#include "core/camera/stages/shutter.h"

namespace btr {
namespace {

constexpr std::array<double, 3> lumaShares{0.299, 0.587, 0.114};  // BT.601
constexpr double roundingVariance = 1.0 / 12 / 255 / 255;
constexpr float steepest = 0.03f;                // of white from pixel to pixel: more is an edge
constexpr std::size_t mostPixelsOfPhoto = 4000;  // of a photograph

// The colour stage without what is fitted.
CameraSpec filterOnly(CameraSpec spec) {
  for (const char* name : {"red_r2", "red_r4", "green_r2", "green_r4", "blue_r2", "blue_r4"})
    spec[CameraStage::colour].values[name] = 0;
  for (const char* name : {"red_gain", "green_gain", "blue_gain"}) spec[CameraStage::colour].values[name] = 1;
  return spec;
}

LightPicture lightOn(const CameraSpec& spec, const PinholePicture& scene) {
  const LensMap lens(spec);
  const Shutter shutter(spec);
  float exposed = 0;
  for (const MomentShare& share : shutter.sharesOfRow(0)) exposed += share.weight;
  LightPicture light{spec.width, spec.height, {}};
  const std::size_t stride = 3 * static_cast<std::size_t>(spec.width);
  light.rgb.assign(stride * static_cast<std::size_t>(spec.height), 0.0f);
  for (int y = 0; y < spec.height; ++y)
    lens.addRow(scene.rgb, y, exposed, light.rgb.data() + stride * static_cast<std::size_t>(y));
  if (spec[CameraStage::colour].on) ColourFilter(filterOnly(spec)).apply(light);
  return light;
}

bool isEven(const LightPicture& light, int x, int y) {
  const auto at = [&](int column, int row, std::size_t c) {
    return light.rgb[3 * static_cast<std::size_t>(row * light.width + column) + c];
  };
  for (std::size_t c = 0; c < 3; ++c)
    for (int row = y - 1; row <= y + 1; ++row)
      for (int column = x - 1; column <= x + 1; ++column)
        if (std::abs(at(column, row, c) - at(x, y, c)) > steepest) return false;
  return true;
}

// Slope of the code along the signal.
double slopeOf(double signal, double gamma) { return std::pow(signal, 1 / gamma - 1) / gamma; }

}  // namespace

std::vector<ColourSample> colourSamples(const CameraSpec& spec, const ColourView& view) {
  const LightPicture light = lightOn(spec, view.scene);
  const std::vector<float> squares = squaredRadii(spec);
  std::vector<std::size_t> even;
  for (int y = 1; y + 1 < spec.height; ++y)
    for (int x = 1; x + 1 < spec.width; ++x)
      if (isEven(light, x, y)) even.push_back(static_cast<std::size_t>(y * spec.width + x));
  std::vector<ColourSample> samples;
  const std::size_t step = 1 + even.size() / mostPixelsOfPhoto;
  for (std::size_t i = 0; i < even.size(); i += step)
    for (std::size_t c = 0; c < 3; ++c)
      samples.push_back(
          {light.rgb[3 * even[i] + c], squares[even[i]], static_cast<int>(c), view.photo.rgb[3 * even[i] + c] / 255.0});
  return samples;
}

ColourNumbers colourNumbersOf(const CameraSpec& spec) {
  ColourNumbers n{1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1};
  const auto take = [&](CameraStage stage, std::size_t number, const char* name) {
    if (spec[stage].on) n[number] = spec.number(stage, name);
  };
  take(CameraStage::colour, redGain, "red_gain");
  take(CameraStage::colour, greenGain, "green_gain");
  take(CameraStage::colour, blueGain, "blue_gain");
  take(CameraStage::vignetting, rim2, "r2");
  take(CameraStage::vignetting, rim4, "r4");
  take(CameraStage::vignetting, rim6, "r6");
  take(CameraStage::colour, redCast2, "red_r2");
  take(CameraStage::colour, redCast4, "red_r4");
  take(CameraStage::colour, blueCast2, "blue_r2");
  take(CameraStage::colour, blueCast4, "blue_r4");
  take(CameraStage::gamma, gammaPower, "gamma");
  return n;
}

CameraSpec withColourNumbers(CameraSpec spec, const ColourNumbers& n) {
  auto& rim = spec[CameraStage::vignetting];
  auto& colour = spec[CameraStage::colour];
  // A colour stage that was off has neither light nor filter: what it would have had is not part of the fit.
  if (!colour.on) colour.values.clear();
  rim.on = colour.on = spec[CameraStage::gamma].on = true;
  rim.values = {{"r2", n[rim2]}, {"r4", n[rim4]}, {"r6", n[rim6]}};
  const Values fitted{{"red_gain", n[redGain]}, {"green_gain", n[greenGain]}, {"blue_gain", n[blueGain]},
                      {"red_r2", n[redCast2]},  {"red_r4", n[redCast4]},      {"green_r2", 0.0},
                      {"green_r4", 0.0},        {"blue_r2", n[blueCast2]},    {"blue_r4", n[blueCast4]}};
  for (const auto& [name, value] : fitted) colour.values[name] = value;
  spec[CameraStage::gamma].values["gamma"] = n[gammaPower];
  return spec;
}

NoiseFit fitNoise(const std::vector<ColourSample>& samples, const ColourNumbers& n) {
  Eigen::Vector2d estimate(1e-4, 0);  // read², shot
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Identity();
  constexpr int rounds = 8;  // each with the weights of the one before
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i + 2 < samples.size(); i += 3) {
      double residual = 0;
      Eigen::Vector2d part(0, 0);
      double rounding = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double signal = signalOf(samples[i + c], n.data());
        const double scaled = lumaShares[c] * slopeOf(signal, n[gammaPower]);
        residual += lumaShares[c] * (samples[i + c].code - codeOf(samples[i + c], n.data()));
        part += scaled * scaled * Eigen::Vector2d(1, signal);
        rounding += lumaShares[c] * lumaShares[c] * roundingVariance;
      }
      const double variance = std::max(part.dot(estimate.cwiseMax(0)), 0.0) + rounding;
      const double weight = 1 / (2 * variance * variance);  // of a squared normal
      normal += weight * part * part.transpose();
      right += weight * part * (residual * residual - rounding);
    }
    inverse = normal.ldlt().solve(Eigen::Matrix2d::Identity());
    estimate = inverse * right;
  }
  NoiseFit fit;
  fit.read = std::sqrt(std::max(estimate[0], 0.0));
  fit.shot = std::max(estimate[1], 0.0);
  fit.shotDeviation = std::sqrt(inverse(1, 1));
  fit.readDeviation = fit.read > 0 ? std::sqrt(inverse(0, 0)) / (2 * fit.read) : std::pow(inverse(0, 0), 0.25);
  return fit;
}

double noiseLevel(const std::vector<ColourSample>& samples, const ColourNumbers& n, const NoiseFit& noise) {
  double sum = 0;
  for (const ColourSample& sample : samples) {
    const double signal = signalOf(sample, n.data()), slope = slopeOf(signal, n[gammaPower]);
    sum += slope * slope * (noise.read * noise.read + noise.shot * signal) + roundingVariance;
  }
  return samples.empty() ? 0 : 255 * std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace btr
