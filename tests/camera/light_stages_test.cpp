// Vignetting, colour, noise and gamma against their formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "core/camera/stages/colour.h"
#include "core/camera/stages/gamma.h"
#include "core/camera/stages/noise.h"
#include "core/camera/stages/rim.h"
#include "tests/camera/pictures.h"

namespace btr::test {
namespace {

LightPicture evenLight(const CameraSpec& spec, float r, float g, float b) {
  return {spec.width, spec.height, flat({spec.width, spec.height, 1, 0, 0}, r, g, b).rgb};
}

TEST(CameraVignetting, IsThePolynomialOfTheRadius) {
  const CameraSpec spec =
      with(plainCamera(65, 49), CameraStage::vignetting, {{"r2", -0.2}, {"r4", -0.1}, {"r6", 0.05}});
  LightPicture picture = evenLight(spec, 1, 0.5f, 0.25f);
  Vignetting(spec).apply(picture);
  const auto at = [&](int x, int y) { return picture.rgb[3 * static_cast<std::size_t>(y * 65 + x)]; };
  EXPECT_FLOAT_EQ(at(32, 24), 1);
  EXPECT_FLOAT_EQ(at(0, 0), 1 - 0.2f - 0.1f + 0.05f);  // the corner: radius 1
  EXPECT_FLOAT_EQ(at(64, 48), at(0, 0));
  const double q = 32.0 * 32.0 / (32.0 * 32.0 + 24.0 * 24.0);  // the middle of the left side
  EXPECT_NEAR(at(0, 24), 1 - 0.2 * q - 0.1 * q * q + 0.05 * q * q * q, 1e-6);
  EXPECT_FLOAT_EQ(picture.rgb[1], 0.5f * at(0, 0));
}

TEST(CameraColour, FilterIsAMatrixAndGains) {
  const CameraSpec spec =
      with(plainCamera(), CameraStage::colour,
           {{"red_from_red", 0.8}, {"red_from_blue", 0.1}, {"green_from_red", -0.2}, {"blue_gain", 1.5}});
  LightPicture picture = evenLight(spec, 0.5f, 0.4f, 0.2f);
  ColourFilter(spec).apply(picture);
  EXPECT_NEAR(picture.rgb[0], 0.8 * 0.5 + 0.1 * 0.2, 1e-6);
  EXPECT_NEAR(picture.rgb[1], 0.4 - 0.2 * 0.5, 1e-6);
  EXPECT_NEAR(picture.rgb[2], 1.5 * 0.2, 1e-6);
}

TEST(CameraColour, WhiteIsBalancedBeforeTheFilter) {
  const CameraSpec spec =
      with(plainCamera(), CameraStage::colour,
           {{"light_k", 3000}, {"balance_k", 3000}, {"red_from_red", 0.7}, {"red_from_green", 0.3}});
  LightPicture picture = evenLight(spec, 1, 1, 1);
  ColourFilter(spec).apply(picture);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(picture.rgb[c], 1, 1e-6);
}

TEST(CameraColour, WhiteIsWhiteOnlyUnderTheLightItIsBalancedFor) {
  const auto white = [](double light, double balance) {
    const CameraSpec spec = with(plainCamera(), CameraStage::colour, {{"light_k", light}, {"balance_k", balance}});
    LightPicture picture = evenLight(spec, 1, 1, 1);
    ColourFilter(spec).apply(picture);
    return std::array<double, 3>{picture.rgb[0], picture.rgb[1], picture.rgb[2]};
  };
  for (const double k : {2856.0, 5000.0, 6500.0})
    for (const double channel : white(k, k)) EXPECT_NEAR(channel, 1, 1e-6);
  EXPECT_GT(white(2856, 5000)[0], 1.3);  // a bulb is red to a camera set to daylight
  EXPECT_LT(white(2856, 5000)[2], 0.7);
  EXPECT_GT(white(6500, 2856)[2], 1.5);
}

// Planck's law in Wien's limit: the ratio of two wavelengths is (λ₂/λ₁)^5·exp(c₂/T·(1/λ₂ − 1/λ₁)).
TEST(CameraColour, LightFollowsPlanck) {
  const double t = 2000, c2 = 1.4387769e-2;
  const double wien = std::pow(540.0 / 610, 5) * std::exp(c2 / t * (1 / 540e-9 - 1 / 610e-9));
  EXPECT_NEAR(lightOf(t)[0], wien, 1e-4 * wien);
  EXPECT_DOUBLE_EQ(lightOf(t)[1], 1);
}

TEST(CameraColour, CastGrowsTowardsTheRim) {
  const CameraSpec spec =
      with(plainCamera(65, 49), CameraStage::colour, {{"blue_r2", 0.2}, {"blue_r4", 0.1}, {"red_r2", -0.1}});
  LightPicture picture = evenLight(spec, 0.5f, 0.5f, 0.5f);
  ColourFilter(spec).apply(picture);
  EXPECT_FLOAT_EQ(picture.rgb[2], 0.5f * 1.3f);
  EXPECT_FLOAT_EQ(picture.rgb[0], 0.5f * 0.9f);
  EXPECT_FLOAT_EQ(picture.rgb[1], 0.5f);
  const std::size_t middle = 3 * (24 * 65 + 32);
  EXPECT_FLOAT_EQ(picture.rgb[middle + 2], 0.5f);
}

/// Mean and variance of one grey over frames × pixels × channels, with the pattern off.
std::pair<double, double> noiseOf(const CameraSpec& spec, float grey, int frames) {
  const SensorNoise noise(spec);
  double sum = 0, square = 0, count = 0;
  for (int frame = 0; frame < frames; ++frame) {
    LightPicture picture = evenLight(spec, grey, grey, grey);
    noise.apply(picture, static_cast<std::uint64_t>(frame));
    for (const float value : picture.rgb) {
      sum += value;
      square += static_cast<double>(value) * value;
      ++count;
    }
  }
  const double mean = sum / count;
  return {mean, square / count - mean * mean};
}

TEST(CameraNoise, HasTheVarianceOfTheFormula) {
  const double read = 0.01, shot = 0.002, db = 6;
  const CameraSpec spec =
      with(plainCamera(), CameraStage::noise,
           {{"read", read}, {"shot", shot}, {"gain_db", db}, {"pattern_offset", 0}, {"pattern_gain", 0}});
  const double gain = std::pow(10, db / 20);
  constexpr int frames = 60;
  const double samples = frames * 64.0 * 48.0 * 3;
  for (const float grey : {0.0f, 0.1f, 0.5f, 0.9f}) {
    const auto [mean, variance] = noiseOf(spec, grey, frames);
    const double expected = gain * gain * (read * read + shot * static_cast<double>(grey));
    EXPECT_NEAR(mean, gain * static_cast<double>(grey), 5 * std::sqrt(expected / samples));
    // A variance of n normal samples deviates by √(2/n).
    EXPECT_NEAR(variance, expected, 5 * std::sqrt(2 / samples) * expected);
  }
}

TEST(CameraNoise, NeighboursChannelsAndFramesAreIndependent) {
  const CameraSpec spec =
      with(plainCamera(), CameraStage::noise, {{"read", 0.01}, {"pattern_offset", 0}, {"pattern_gain", 0}});
  const SensorNoise noise(spec);
  LightPicture one = evenLight(spec, 0.5f, 0.5f, 0.5f), two = one;
  noise.apply(one, 1);
  noise.apply(two, 2);
  const auto correlation = [](const std::vector<float>& a, std::size_t shift, const std::vector<float>& b) {
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i + shift < a.size(); ++i) {
      const double x = a[i] - 0.5, y = b[i + shift] - 0.5;
      ab += x * y;
      aa += x * x;
      bb += y * y;
    }
    return ab / std::sqrt(aa * bb);
  };
  const double bound = 5 / std::sqrt(static_cast<double>(one.rgb.size()));
  for (const std::size_t shift : {1u, 2u, 3u, 4u, 192u})
    EXPECT_LT(std::abs(correlation(one.rgb, shift, one.rgb)), bound);
  EXPECT_LT(std::abs(correlation(one.rgb, 0, two.rgb)), bound);
}

TEST(CameraNoise, PatternIsTheSameInEveryFrameAndAnotherForAnotherSeed) {
  CameraSpec spec = with(plainCamera(), CameraStage::noise,
                         {{"read", 0}, {"shot", 0}, {"pattern_offset", 0.02}, {"pattern_gain", 0.05}});
  const auto frame = [&](std::uint64_t number) {
    LightPicture picture = evenLight(spec, 0.5f, 0.5f, 0.5f);
    SensorNoise(spec).apply(picture, number);
    return picture.rgb;
  };
  const std::vector<float> first = frame(0);
  EXPECT_EQ(first, frame(17));
  double square = 0;
  for (const float value : first) square += std::pow(value - 0.5, 2) / static_cast<double>(first.size());
  const double expected = 0.02 * 0.02 + 0.25 * 0.05 * 0.05;
  EXPECT_NEAR(square, expected, 5 * std::sqrt(2.0 / static_cast<double>(first.size())) * expected);
  spec.seed = 2;
  EXPECT_NE(first, frame(0));
}

TEST(CameraGamma, IsThePowerWithinHalfAByte) {
  for (const double gamma : {1.0, 1.8, 2.2, 3.0}) {
    const CameraSpec spec = with(plainCamera(), CameraStage::gamma, {{"gamma", gamma}});
    LightPicture picture{50, 20, {}};
    for (int i = 0; i < 3000; ++i) picture.rgb.push_back(static_cast<float>(i) / 2500 - 0.1f);
    const std::vector<float> before = picture.rgb;
    GammaCurve(spec).apply(picture);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double clipped = std::min(std::max(static_cast<double>(before[i]), 0.0), 1.0);
      EXPECT_NEAR(picture.rgb[i], std::pow(clipped, 1 / gamma), 0.5 / 255) << before[i];
    }
  }
}

}  // namespace
}  // namespace btr::test
