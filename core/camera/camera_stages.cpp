// The stages of a camera: names, and their numbers with bounds.
#include <array>

#include "core/camera/camera_spec.h"
#include "core/spec/require.h"

namespace btr {
namespace {

constexpr std::array<CameraStage, cameraStageCount> allStages{
    CameraStage::lens,  CameraStage::vignetting, CameraStage::shutter, CameraStage::colour, CameraStage::noise,
    CameraStage::gamma, CameraStage::ycbcr,      CameraStage::classes, CameraStage::jpeg};

struct StageWords {
  const char *name, *meaning;
};

constexpr std::array<StageWords, cameraStageCount> stageWords{{
    {"lens", "bends straight lines: Brown's radial and tangential terms as OpenCV defines them"},
    {"vignetting", "darkens the rim"},
    {"shutter", "rows are read one after the other, each after a time of exposure: slanted and blurred motion"},
    {"colour", "light and white balance, colour filter, cast at the rim"},
    {"noise", "amplifier, shot, read and fixed-pattern noise"},
    {"gamma", "codes light as a display expects it"},
    {"ycbcr", "YCbCr 4:2:2 with 8 bits as the robot gives it"},
    {"classes", "a colour table: the class of each pixel"},
    {"jpeg", "compresses as for a slow radio link"},
}};

Parameter lensTerm(const char* name, const char* meaning, double bound) {
  return {name, "", meaning, -bound, bound, 0, 0};
}

Parameter radialTerm(const char* name, const char* meaning) { return {name, "", meaning, -2, 2, 0, 0}; }

Parameter matrixTerm(const char* name, const char* meaning, double byDefault) {
  return {name, "", meaning, -4, 4, byDefault, byDefault};
}

std::vector<Parameter> lensParameters() {
  return {lensTerm("k1", "radial, times the square of the radius in focal lengths", 2),
          lensTerm("k2", "radial, times its 4th power", 5), lensTerm("k3", "radial, times its 6th power", 10),
          lensTerm("p1", "tangential, from a lens leaning about x", 0.2),
          lensTerm("p2", "tangential, from a lens leaning about y", 0.2)};
}

std::vector<Parameter> vignettingParameters() {
  return {radialTerm("r2", "gain at the corner: the part with the square of the radius (1 at the corner)"),
          radialTerm("r4", "the part with its 4th power"), radialTerm("r6", "the part with its 6th power")};
}

std::vector<Parameter> shutterParameters() {
  return {{"exposure_s", "s", "how long each row gathers light", 1e-5, 0.2, 0.005},
          {"full_light_s", "s", "the exposure at which white in full light is 1", 1e-5, 0.2, 0.005},
          {"readout_s", "s", "from reading the first row to reading the last", 0, 0.2, 0.03, 0.0},
          {"moments", "", "pictures that are rendered for each frame", 1, 64, 5, {}, true}};
}

std::vector<Parameter> colourParameters() {
  return {{"light_k", "K", "colour temperature of the light", 1500, 15000, 5000},
          {"balance_k", "K", "colour temperature that the camera takes for white", 1500, 15000, 5000},
          {"red_gain", "", "of the red channel", 0, 8, 1, 1},
          {"green_gain", "", "of the green channel", 0, 8, 1, 1},
          {"blue_gain", "", "of the blue channel", 0, 8, 1, 1},
          matrixTerm("red_from_red", "colour filter", 1),
          matrixTerm("red_from_green", "colour filter", 0),
          matrixTerm("red_from_blue", "colour filter", 0),
          matrixTerm("green_from_red", "colour filter", 0),
          matrixTerm("green_from_green", "colour filter", 1),
          matrixTerm("green_from_blue", "colour filter", 0),
          matrixTerm("blue_from_red", "colour filter", 0),
          matrixTerm("blue_from_green", "colour filter", 0),
          matrixTerm("blue_from_blue", "colour filter", 1),
          radialTerm("red_r2", "cast at the corner, red: the part with the square of the radius (1 at the corner)"),
          radialTerm("red_r4", "the part with its 4th power"),
          radialTerm("green_r2", "cast at the corner, green"),
          radialTerm("green_r4", "the part with its 4th power"),
          radialTerm("blue_r2", "cast at the corner, blue"),
          radialTerm("blue_r4", "the part with its 4th power")};
}

std::vector<Parameter> noiseParameters() {
  return {{"gain_db", "dB", "amplifier: the signal times 10^(dB/20)", -20, 40, 0, 0.0},
          {"read", "", "standard deviation without light, before the amplifier", 0, 0.5, 0.004, 0.0},
          {"shot", "", "variance for each unit of signal, before the amplifier", 0, 0.1, 0.0005, 0.0},
          {"pattern_offset", "", "standard deviation from pixel to pixel, the same in every frame", 0, 0.5, 0.001, 0.0},
          {"pattern_gain", "", "the same for the gain of a pixel", 0, 0.5, 0.005, 0.0}};
}

std::vector<Parameter> ycbcrParameters() {
  Parameter range{"range", "", "full: all of 0 to 255; studio: Y 16 to 235, Cb and Cr 16 to 240 (BT.601)", 0, 1, 0};
  range.choices = {"full", "studio"};
  return {range};
}

std::array<std::vector<Parameter>, cameraStageCount> declare() {
  return {lensParameters(),
          vignettingParameters(),
          shutterParameters(),
          colourParameters(),
          noiseParameters(),
          {{"gamma", "", "the signal to the power of 1/gamma", 0.2, 5, 2.2, 1.0}},
          ycbcrParameters(),
          {},
          {{"quality", "", "as JPEG libraries count", 1, 100, 75, {}, true}}};
}

}  // namespace

std::span<const CameraStage> cameraStages() { return allStages; }

std::string nameOf(CameraStage stage) { return stageWords[static_cast<std::size_t>(stage)].name; }

std::optional<CameraStage> cameraStageNamed(const std::string& name) {
  for (const CameraStage stage : allStages)
    if (nameOf(stage) == name) return stage;
  return {};
}

std::string meaningOf(CameraStage stage) { return stageWords[static_cast<std::size_t>(stage)].meaning; }

std::span<const Parameter> parametersOf(CameraStage stage) {
  static const std::array<std::vector<Parameter>, cameraStageCount> declared = declare();
  return declared[static_cast<std::size_t>(stage)];
}

double CameraSpec::number(CameraStage stage, const std::string& parameter) const {
  return valueOf(parametersOf(stage), (*this)[stage].values, parameter);
}

}  // namespace btr
