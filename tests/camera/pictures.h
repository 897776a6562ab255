#pragma once
// Pictures that tests draw for a camera.
#include <limits>

#include "core/camera/camera_pipeline.h"

namespace btr::test {

/// A sensor of that size, looking straight, all stages off.
inline CameraSpec plainCamera(int width = 64, int height = 48) {
  CameraSpec spec;
  spec.name = "test";
  spec.width = width;
  spec.height = height;
  spec.focal_px = width;
  spec.centreX_px = (width - 1) / 2.0;
  spec.centreY_px = (height - 1) / 2.0;
  return spec;
}

inline CameraSpec with(CameraSpec spec, CameraStage stage, Values values = {}) {
  spec[stage] = {true, std::move(values)};
  return spec;
}

/// A picture of the wanted size, its pixels from `draw(x, y, rgb)`; nothing is behind it.
template <class Draw>
PinholePicture drawn(const Pinhole& pinhole, const Draw& draw) {
  PinholePicture picture;
  picture.pinhole = pinhole;
  const std::size_t pixels = static_cast<std::size_t>(pinhole.width) * static_cast<std::size_t>(pinhole.height);
  picture.rgb.resize(3 * pixels);
  picture.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  picture.object.assign(pixels, 0);
  for (int y = 0; y < pinhole.height; ++y)
    for (int x = 0; x < pinhole.width; ++x)
      draw(x, y,
           picture.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pinhole.width) +
                                     static_cast<std::size_t>(x)));
  return picture;
}

inline PinholePicture flat(const Pinhole& pinhole, float r, float g, float b) {
  return drawn(pinhole, [=](int, int, float* rgb) {
    rgb[0] = r;
    rgb[1] = g;
    rgb[2] = b;
  });
}

/// All that differs from pixel to pixel and from channel to channel.
inline PinholePicture varied(const Pinhole& pinhole) {
  return drawn(pinhole, [&](int x, int y, float* rgb) {
    rgb[0] = static_cast<float>(x) / static_cast<float>(pinhole.width);
    rgb[1] = static_cast<float>(y) / static_cast<float>(pinhole.height);
    rgb[2] = static_cast<float>((x * 7 + y * 13) % 32) / 32;
  });
}

inline CameraFrame processOne(const CameraPipeline& camera, const PinholePicture& picture, std::uint64_t frame = 0) {
  return camera.process({&picture, 1}, frame);
}

/// Channel c of a frame's pixel.
inline int pixelOf(const CameraFrame& frame, int x, int y, int c) {
  return frame.rgb[3 * static_cast<std::size_t>(y * frame.width + x) + static_cast<std::size_t>(c)];
}

}  // namespace btr::test
