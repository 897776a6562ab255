#include "core/openr/runtime/robot/vectors.h"

#include <cstddef>

namespace btr::openr {
namespace {

longword number(std::size_t value) { return static_cast<longword>(value); }

void initInfo(ODataVectorInfo& info, MemoryRegionID id, ODataType type, std::size_t infoBytes, std::size_t most,
              std::size_t total) {
  info.memRegionID = id;
  info.physAddr = 0;
  info.offset = 0;
  info.totalSize = number(total);
  info.type = type;
  info.infoOffset = sizeof(ODataVectorInfo);
  info.infoSize = number(infoBytes);
  info.maxNumData = number(most);
  info.numData = 0;
  info.syncKey = ovrsynckeyUNDEF;
  info.wait = 0;
  info.optOffset = offsetof(ODataVectorInfo, optional);
  info.optSize = 0;
}

}  // namespace

std::size_t commandVectorBytes(std::size_t commands) {
  return sizeof(ODataVectorInfo) + commands * (sizeof(OCommandInfo) + sizeof(OCommandData));
}

void initCommandVector(OCommandVectorData* vector, MemoryRegionID id, std::size_t commands) {
  initInfo(vector->vectorInfo, id, odataCOMMAND_VECTOR, sizeof(OCommandInfo), commands, commandVectorBytes(commands));
  for (std::size_t i = 0; i < commands; ++i) {
    OCommandInfo* info = vector->GetInfo(static_cast<int>(i));
    info->type = odataUNDEF;
    info->primitiveID = oprimitiveID_UNDEF;
    info->frameNumber = oframeINVALID_NUMBER;
    info->frameSize = sizeof(OCommandValue);
    info->dataSize = sizeof(OCommandData);
    info->dataOffset = number(sizeof(ODataVectorInfo) + commands * sizeof(OCommandInfo) + i * sizeof(OCommandData));
  }
}

std::size_t sensorVectorBytes(std::size_t sensors) {
  return sizeof(ODataVectorInfo) + sensors * (sizeof(OSensorFrameInfo) + sizeof(OSensorFrameData));
}

void initSensorVector(OSensorFrameVectorData* vector, MemoryRegionID id, std::size_t sensors) {
  initInfo(vector->vectorInfo, id, odataSENSOR_FRAME_VECTOR, sizeof(OSensorFrameInfo), sensors,
           sensorVectorBytes(sensors));
  for (std::size_t i = 0; i < sensors; ++i) {
    OSensorFrameInfo* info = vector->GetInfo(static_cast<int>(i));
    info->frameSize = sizeof(OSensorValue);
    info->dataSize = sizeof(OSensorFrameData);
    info->dataOffset =
        number(sizeof(ODataVectorInfo) + sensors * sizeof(OSensorFrameInfo) + i * sizeof(OSensorFrameData));
  }
}

std::size_t soundVectorBytes(std::size_t sounds, std::size_t dataBytes) {
  return sizeof(ODataVectorInfo) + sounds * (sizeof(OSoundInfo) + dataBytes);
}

void initSoundVector(OSoundVectorData* vector, MemoryRegionID id, std::size_t sounds, std::size_t dataBytes) {
  initInfo(vector->vectorInfo, id, odataSOUND_VECTOR, sizeof(OSoundInfo), sounds, soundVectorBytes(sounds, dataBytes));
  for (std::size_t i = 0; i < sounds; ++i) {
    OSoundInfo* info = vector->GetInfo(static_cast<int>(i));
    info->primitiveID = oprimitiveID_UNDEF;
    info->frameNumber = oframeINVALID_NUMBER;
    info->frameSize = 0;
    info->maxDataSize = number(dataBytes);
    info->dataOffset = number(sizeof(ODataVectorInfo) + sounds * sizeof(OSoundInfo) + i * dataBytes);
    info->format = osoundformatUNDEF;
    info->channel = osoundchannelUNDEF;
  }
}

std::size_t imageVectorBytes(std::size_t width, std::size_t height) {
  const std::size_t pixels = width * height;
  return sizeof(ODataVectorInfo) + 4 * sizeof(OFbkImageInfo) + 6 * (pixels + pixels / 4 + pixels / 16) + pixels / 4;
}

void initImageVector(OFbkImageVectorData* vector, MemoryRegionID id, std::size_t width, std::size_t height) {
  initInfo(vector->vectorInfo, id, odataFBKIMAGE_VECTOR, sizeof(OFbkImageInfo), 4, imageVectorBytes(width, height));
  vector->vectorInfo.numData = 4;
  std::size_t at = sizeof(ODataVectorInfo) + 4 * sizeof(OFbkImageInfo);
  for (int layer = ofbkimageLAYER_H; layer <= ofbkimageLAYER_C; ++layer) {
    // The colours that were found have the size of layer M.
    const std::size_t by = std::size_t{1} << (layer == ofbkimageLAYER_C ? ofbkimageLAYER_M : layer);
    OFbkImageInfo* info = vector->GetInfo(layer);
    info->type = layer == ofbkimageLAYER_C ? odataFBK_CDT : odataFBK_YCrCb_HPF;
    info->width = number(width / by);
    info->height = number(height / by);
    info->dataOffset = number(at);
    info->dataSize = number((layer == ofbkimageLAYER_C ? 1 : 6) * (width / by) * (height / by));
    at += info->dataSize;
  }
}

void initCdtVector(OCdtVectorData* vector, MemoryRegionID id) {
  initInfo(vector->vectorInfo, id, odataCDT_VECTOR, sizeof(OCdtInfo), ocdtNUM_CHANNELS, sizeof(OCdtVectorData));
  for (int i = 0; i < ocdtNUM_CHANNELS; ++i) vector->GetInfo(i)->Init(oprimitiveID_UNDEF, ocdtCHANNEL_UNDEF);
}

}  // namespace btr::openr
