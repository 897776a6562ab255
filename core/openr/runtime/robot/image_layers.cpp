#include "core/openr/runtime/robot/image_layers.h"

#include <algorithm>
#include <cstring>

namespace btr::openr {
namespace {

/// One plane of bytes with a distance from row to row.
struct Plane {
  byte* at;
  std::size_t stride;
  byte& pixel(std::size_t x, std::size_t y) const { return at[y * stride + x]; }
};

byte offset(int value) { return static_cast<byte>(std::clamp(value + 128, 0, 255)); }

/// The quarters of a sum to the nearest.
int quarter(int sum) { return (sum + (sum >= 0 ? 2 : -2)) / 4; }

void halve(const Plane& from, const Plane& to, std::size_t width, std::size_t height) {
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      to.pixel(x, y) = static_cast<byte>((from.pixel(2 * x, 2 * y) + from.pixel(2 * x + 1, 2 * y) +
                                          from.pixel(2 * x, 2 * y + 1) + from.pixel(2 * x + 1, 2 * y + 1) + 2) /
                                         4);
}

void split(const Plane& from, const Plane& lh, const Plane& hl, const Plane& hh, std::size_t width,
           std::size_t height) {
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const int p00 = from.pixel(2 * x, 2 * y), p10 = from.pixel(2 * x + 1, 2 * y), p01 = from.pixel(2 * x, 2 * y + 1),
                p11 = from.pixel(2 * x + 1, 2 * y + 1);
      lh.pixel(x, y) = offset(quarter(p01 + p11 - p00 - p10));
      hl.pixel(x, y) = offset(quarter(p10 + p11 - p00 - p01));
      hh.pixel(x, y) = offset(quarter(p00 + p11 - p10 - p01));
    }
}

/// Band `band` of a layer: rows of six bands.
Plane bandOf(OFbkImageVectorData* vector, int layer, int band) {
  const std::size_t width = vector->GetInfo(layer)->width;
  return {vector->GetData(layer) + static_cast<std::size_t>(band) * width, 6 * width};
}

/// Order of the bands in a row.
enum Band { Y, Cr, Cb, LH, HL, HH };

bool within(longword box, byte cr, byte cb) {
  if (box == ocdtINIT) return false;  // as it is before it is set: no colour
  return cr <= ((box & ocdtCr_MAX_MASK) >> 8) && cr >= (box & ocdtCr_MIN_MASK) &&
         cb <= ((box & ocdtCb_MAX_MASK) >> 24) && cb >= ((box & ocdtCb_MIN_MASK) >> 16);
}

void tag(byte* lastRow, std::size_t width, word fieldCounter, const std::array<std::size_t, 8>& counts) {
  if (width < 12) return;
  std::memset(lastRow, 0, 12);
  lastRow[0] = static_cast<byte>(fieldCounter & 0xff);
  lastRow[1] = static_cast<byte>(fieldCounter >> 8);
  for (std::size_t channel = 0; channel < 8; ++channel)
    lastRow[channel < 4 ? 8 + channel : channel] = static_cast<byte>(std::min<std::size_t>(counts[channel] / 16, 255));
}

}  // namespace

void fillLayers(OFbkImageVectorData* vector, const CameraImage& image, const ColourTables& colours, word fieldCounter) {
  const std::size_t width = vector->GetInfo(0)->width, height = vector->GetInfo(0)->height;
  const bool full = image.width == 2 * width && image.height == 2 * height;
  if (!full && (image.width != width || image.height != height)) return;
  auto* rows = const_cast<byte*>(image.rows.data());
  for (int band = Y; band <= Cb; ++band) {
    const Plane from{rows + static_cast<std::size_t>(band) * image.width, std::size_t{3} * image.width};
    const Plane to = bandOf(vector, 0, band);
    if (full)
      halve(from, to, width, height);
    else
      for (std::size_t y = 0; y < height; ++y) std::memcpy(&to.pixel(0, y), &from.pixel(0, y), width);
  }
  const Plane brightness{rows, std::size_t{3} * image.width};
  if (full) {
    split(brightness, bandOf(vector, 0, LH), bandOf(vector, 0, HL), bandOf(vector, 0, HH), width, height);
  } else {
    for (int band = LH; band <= HH; ++band)
      for (std::size_t y = 0; y < height; ++y) std::memset(&bandOf(vector, 0, band).pixel(0, y), 128, width);
  }
  for (int layer = 1; layer <= 2; ++layer) {
    const std::size_t w = vector->GetInfo(layer)->width, h = vector->GetInfo(layer)->height;
    for (int band = Y; band <= Cb; ++band) halve(bandOf(vector, layer - 1, band), bandOf(vector, layer, band), w, h);
    split(bandOf(vector, layer - 1, Y), bandOf(vector, layer, LH), bandOf(vector, layer, HL), bandOf(vector, layer, HH),
          w, h);
  }

  std::array<std::size_t, 8> counts{};
  const Plane y1 = bandOf(vector, ofbkimageLAYER_M, Y), cr1 = bandOf(vector, ofbkimageLAYER_M, Cr),
              cb1 = bandOf(vector, ofbkimageLAYER_M, Cb);
  const std::size_t foundWidth = vector->GetInfo(ofbkimageLAYER_C)->width,
                    foundHeight = vector->GetInfo(ofbkimageLAYER_C)->height;
  const Plane found{vector->GetData(ofbkimageLAYER_C), foundWidth};
  for (std::size_t y = 0; y < foundHeight; ++y)
    for (std::size_t x = 0; x < foundWidth; ++x) {
      const std::size_t segment = y1.pixel(x, y) >> 3;
      byte channels = 0;
      for (std::size_t channel = 0; channel < 8; ++channel)
        if (within(colours[channel][segment], cr1.pixel(x, y), cb1.pixel(x, y))) {
          channels = static_cast<byte>(channels | (1u << channel));
          ++counts[channel];
        }
      found.pixel(x, y) = channels;
    }
  for (int layer = 0; layer <= 2; ++layer)
    tag(&bandOf(vector, layer, Y).pixel(0, vector->GetInfo(layer)->height - 1), vector->GetInfo(layer)->width,
        fieldCounter, counts);
  tag(&found.pixel(0, foundHeight - 1), foundWidth, fieldCounter, counts);
}

}  // namespace btr::openr
