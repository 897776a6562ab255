#pragma once
#include <OPENR/ODataFormats.h>

#include <array>

#include "core/openr/robot_link.h"

namespace btr::openr {

/// Boxes of colours of each channel, by segment of brightness; as OCdtInfo packs them.
using ColourTables = std::array<std::array<longword, 32>, 8>;

/// Fills layers H, M, L and C of a vector that initImageVector() made, each with its tag in the last row. The picture
/// has twice the width and height of layer H, or the same: then bands LH, HL and HH are flat. Per 2 × 2 pixels
///   LL = mean, LH = (p01 + p11 − p00 − p10) / 4, HL = (p10 + p11 − p00 − p01) / 4, HH = (p00 + p11 − p10 − p01) / 4
/// with pxy at column x and row y, offset by 128 but for LL. Layer C tells which channels each pixel of layer M is in:
/// programs of ERS-210 (88 × 72) and ERS-7 (104 × 80) count on that size.
void fillLayers(OFbkImageVectorData* vector, const CameraImage& image, const ColourTables& colours, word fieldCounter);

}  // namespace btr::openr
