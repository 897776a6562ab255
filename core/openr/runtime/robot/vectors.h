#pragma once
#include <OPENR/ODataFormats.h>

namespace btr::openr {

// Fills in the empty vectors that programs are given: sizes and offsets. Data begin behind the infos.

std::size_t commandVectorBytes(std::size_t commands);
void initCommandVector(OCommandVectorData* vector, MemoryRegionID id, std::size_t commands);
std::size_t sensorVectorBytes(std::size_t sensors);
void initSensorVector(OSensorFrameVectorData* vector, MemoryRegionID id, std::size_t sensors);
std::size_t soundVectorBytes(std::size_t sounds, std::size_t dataBytes);
void initSoundVector(OSoundVectorData* vector, MemoryRegionID id, std::size_t sounds, std::size_t dataBytes);
/// With layers H, M, L and C, for a camera whose layer H has this size.
std::size_t imageVectorBytes(std::size_t width, std::size_t height);
void initImageVector(OFbkImageVectorData* vector, MemoryRegionID id, std::size_t width, std::size_t height);
void initCdtVector(OCdtVectorData* vector, MemoryRegionID id);

}  // namespace btr::openr
