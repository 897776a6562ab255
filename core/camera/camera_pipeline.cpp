#include "core/camera/camera_pipeline.h"

#include <cmath>
#include <optional>

#include "core/camera/picture_file.h"
#include "core/camera/stages/bytes.h"
#include "core/camera/stages/classes.h"
#include "core/camera/stages/colour.h"
#include "core/camera/stages/gamma.h"
#include "core/camera/stages/lens.h"
#include "core/camera/stages/noise.h"
#include "core/camera/stages/rim.h"
#include "core/camera/stages/shutter.h"
#include "core/camera/stages/truth.h"
#include "core/spec/require.h"

namespace btr {
namespace {

CameraSpec checkedCamera(CameraSpec spec) {
  check(spec, spec.name);
  return spec;
}

std::vector<std::uint8_t> codedForShowing(LightPicture picture, bool linear) {
  if (linear)
    for (float& value : picture.rgb) value = srgbFromLinear(value);
  return quantised(picture);
}

std::vector<std::uint8_t> srgbBytes(std::vector<std::uint8_t> linear) {
  for (std::uint8_t& byte : linear) byte = toByte(255 * srgbFromLinear(byte / 255.0f));
  return linear;
}

}  // namespace

float linearFromSrgb(float coded) {
  return coded <= 0.04045f ? coded / 12.92f : std::pow((coded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear) {
  if (linear <= 0.0031308f) return 12.92f * std::max(linear, 0.0f);
  return 1.055f * std::pow(std::min(linear, 1.0f), 1 / 2.4f) - 0.055f;
}

std::vector<std::uint8_t> shownRgb(const CameraFrame& frame) { return frame.linear ? srgbBytes(frame.rgb) : frame.rgb; }

/// What is computed once.
struct CameraPipeline::Parts {
  explicit Parts(CameraSpec given)
      : spec(checkedCamera(std::move(given))),
        lens(spec),
        shutter(spec),
        code(spec.number(CameraStage::ycbcr, "range") != 0),
        table(spec) {
    if (on(CameraStage::vignetting)) vignetting.emplace(spec);
    if (on(CameraStage::colour)) colour.emplace(spec);
    if (on(CameraStage::noise)) noise.emplace(spec);
    if (on(CameraStage::gamma)) gamma.emplace(spec);
    for (int y = 0; y < spec.height; ++y) shares.push_back(shutter.sharesOfRow(y));
  }

  bool on(CameraStage stage) const { return spec[stage].on; }
  std::vector<PictureRows> rows() const;
  void checkMoments(std::span<const PinholePicture> moments) const;
  LightPicture gathered(std::span<const PinholePicture> moments, bool throughShutter) const;
  LightPicture light(std::span<const PinholePicture> moments, std::uint64_t frameNumber,
                     const StageWatcher& watcher) const;
  CameraFrame bytes(const LightPicture& picture, const StageWatcher& watcher) const;

  CameraSpec spec;
  LensMap lens;
  Shutter shutter;
  YcbcrCode code;
  ColourTable table;
  std::vector<std::vector<MomentShare>> shares;  // by row
  std::optional<Vignetting> vignetting;
  std::optional<ColourFilter> colour;
  std::optional<SensorNoise> noise;
  std::optional<GammaCurve> gamma;
};

std::vector<PictureRows> CameraPipeline::Parts::rows() const {
  const int height = lens.pinhole().height;
  std::vector<PictureRows> rows(shutter.moments_s().size(), {height, -1});
  for (int y = 0; y < spec.height; ++y)
    for (const MomentShare& share : shares[static_cast<std::size_t>(y)]) {
      PictureRows& read = rows[share.moment];
      const PictureRows more = lens.rowsFor(y);
      read = {std::min(read.first, more.first), std::max(read.last, more.last)};
    }
  for (PictureRows& read : rows)
    if (read.last < read.first) read = {0, 0};
  rows[rows.size() / 2] = {0, height - 1};
  return rows;
}

void CameraPipeline::Parts::checkMoments(std::span<const PinholePicture> moments) const {
  require(moments.size() == shutter.moments_s().size(), "a camera gets one picture for each of its moments");
  const Pinhole& wanted = lens.pinhole();
  const std::size_t pixels = static_cast<std::size_t>(wanted.width) * static_cast<std::size_t>(wanted.height);
  for (const PinholePicture& picture : moments)
    require(picture.pinhole.width == wanted.width && picture.pinhole.height == wanted.height &&
                picture.rgb.size() == 3 * pixels && (picture.depth_m.empty() || picture.depth_m.size() == pixels) &&
                (picture.object.empty() || picture.object.size() == pixels),
            "a camera's pictures have the size of its pinhole()");
}

// Lens and shutter in one: each row of the sensor from those moments that it was exposed at.
LightPicture CameraPipeline::Parts::gathered(std::span<const PinholePicture> moments, bool throughShutter) const {
  LightPicture picture{spec.width, spec.height, {}};
  const std::size_t stride = 3 * static_cast<std::size_t>(spec.width);
  picture.rgb.assign(stride * static_cast<std::size_t>(spec.height), 0.0f);
  for (int y = 0; y < spec.height; ++y) {
    float* row = picture.rgb.data() + stride * static_cast<std::size_t>(y);
    if (!throughShutter) lens.addRow(moments[moments.size() / 2].rgb, y, 1, row);
    if (throughShutter)
      for (const MomentShare& share : shares[static_cast<std::size_t>(y)])
        lens.addRow(moments[share.moment].rgb, y, share.weight, row);
  }
  return picture;
}

LightPicture CameraPipeline::Parts::light(std::span<const PinholePicture> moments, std::uint64_t frameNumber,
                                          const StageWatcher& watcher) const {
  bool linear = true;
  const auto passed = [&](CameraStage stage, const LightPicture& picture) {
    if (watcher && on(stage)) watcher(stage, codedForShowing(picture, linear));
  };
  if (watcher && on(CameraStage::lens)) passed(CameraStage::lens, gathered(moments, false));
  // A gain of each pixel and a mean over moments may change places: the rim is darkened once, not at every moment.
  if (watcher && vignetting) {
    LightPicture before = gathered(moments, false);
    vignetting->apply(before);
    passed(CameraStage::vignetting, before);
  }
  LightPicture picture = gathered(moments, true);
  if (vignetting) vignetting->apply(picture);
  passed(CameraStage::shutter, picture);
  if (colour) colour->apply(picture);
  passed(CameraStage::colour, picture);
  if (noise) noise->apply(picture, frameNumber);
  passed(CameraStage::noise, picture);
  if (gamma) gamma->apply(picture);
  linear = !gamma;
  passed(CameraStage::gamma, picture);
  return picture;
}

CameraFrame CameraPipeline::Parts::bytes(const LightPicture& picture, const StageWatcher& watcher) const {
  CameraFrame frame;
  frame.width = spec.width;
  frame.height = spec.height;
  frame.linear = !on(CameraStage::gamma);
  const auto passed = [&](CameraStage stage) {
    if (watcher) watcher(stage, shownRgb(frame));
  };
  if (on(CameraStage::ycbcr)) {
    frame.ycbcr = code.pairs(picture);
    frame.rgb = code.rgbOfPairs(frame.ycbcr);
    passed(CameraStage::ycbcr);
  } else {
    frame.rgb = quantised(picture);
  }
  if (on(CameraStage::classes)) {
    frame.classes = frame.ycbcr.empty() ? table.ofRgb(frame.rgb) : table.ofPairs(frame.ycbcr);
    if (watcher) watcher(CameraStage::classes, classPicture(frame.width, frame.height, frame.classes).rgb);
  }
  if (on(CameraStage::jpeg)) {
    const int quality = static_cast<int>(spec.number(CameraStage::jpeg, "quality"));
    frame.jpeg = jpegBytes({frame.width, frame.height, frame.rgb}, quality);
    frame.rgb = decodedPicture(frame.jpeg, spec.name).rgb;
    passed(CameraStage::jpeg);
  }
  return frame;
}

CameraPipeline::CameraPipeline(CameraSpec spec) : parts_(std::make_unique<const Parts>(std::move(spec))) {}
CameraPipeline::~CameraPipeline() = default;
CameraPipeline::CameraPipeline(CameraPipeline&&) noexcept = default;
CameraPipeline& CameraPipeline::operator=(CameraPipeline&&) noexcept = default;

const CameraSpec& CameraPipeline::spec() const { return parts_->spec; }
Pinhole CameraPipeline::pinhole() const { return parts_->lens.pinhole(); }
std::vector<double> CameraPipeline::moments_s() const { return parts_->shutter.moments_s(); }

std::vector<PictureRows> CameraPipeline::rows() const { return parts_->rows(); }

CameraFrame CameraPipeline::process(std::span<const PinholePicture> moments, std::uint64_t frameNumber) const {
  return process(moments, frameNumber, {});
}

CameraFrame CameraPipeline::process(std::span<const PinholePicture> moments, std::uint64_t frameNumber,
                                    const StageWatcher& watcher) const {
  parts_->checkMoments(moments);
  CameraFrame frame = parts_->bytes(parts_->light(moments, frameNumber, watcher), watcher);
  frame.truth = truthOf(moments[moments.size() / 2], parts_->lens, frame.width, frame.height);
  return frame;
}

}  // namespace btr
