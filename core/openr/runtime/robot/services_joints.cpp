// Joints' gains, and what a primitive can be asked for beyond its commands.
#include <algorithm>
#include <cstring>

#include "core/openr/runtime/objects/regions.h"
#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/services.h"

namespace btr::openr {
namespace {

template <class T>
bool takeParam(const void* param, std::size_t size, T& value) {
  if (param == nullptr || size < sizeof(T)) return false;
  std::memcpy(static_cast<void*>(&value), param, sizeof(T));
  return true;
}

template <class T>
OStatus give(const T& value, void* result, std::size_t size) {
  if (result == nullptr || size < sizeof(T)) return oINVALID_ARG;
  std::memcpy(result, static_cast<const void*>(&value), sizeof(T));
  return oSUCCESS;
}

}  // namespace

std::vector<std::size_t> Services::jointsOf(OPrimitiveID id) const {
  std::vector<std::size_t> joints;
  const auto add = [&](OPrimitiveID one) {
    const Primitives::Place* place = primitives.find(one);
    if (place != nullptr && place->kind == Primitives::Of::joint) joints.push_back(place->place);
  };
  if (id == oprimitiveID_UNDEF)
    for (const OPrimitiveID one : opened_) add(one);
  else
    add(id);
  return joints;
}

OStatus Services::openPrimitive(const std::string& locator, OPrimitiveID* id) {
  const OPrimitiveID found = primitives.at(locator);
  if (id != nullptr) *id = found;
  if (found == oprimitiveID_UNDEF) {
    std::string others;
    for (const std::string& robot : robotsWith(locator))
      others += (others.empty() ? "" : " and ") + ("the " + robot) + "'s";
    system_.sayOnce("primitives", "the " + system_.design.name + " has no \"" + locator + "\"" +
                                      (others.empty() ? ", nor has another robot" : "; it is " + others));
    return oNOT_FOUND;
  }
  opened_.insert(found);
  return oSUCCESS;
}

OStatus Services::closePrimitive(OPrimitiveID id) { return opened_.erase(id) > 0 ? oSUCCESS : oINVALID_PRIMITIVE_ID; }

OStatus Services::enableGain(OPrimitiveID id, bool enabled) {
  const auto joints = jointsOf(id);
  if (joints.empty() && id != oprimitiveID_UNDEF) return oINVALID_PRIMITIVE_ID;
  for (const std::size_t joint : joints) {
    gains_[joint].enabled = enabled;
    gains_[joint].changedEnabled = true;
  }
  return oSUCCESS;
}

OStatus Services::setGain(OPrimitiveID id, const JointGain& gain) {
  const auto joints = jointsOf(id);
  if (joints.empty() && id != oprimitiveID_UNDEF) return oINVALID_PRIMITIVE_ID;
  OStatus status = oSUCCESS;
  for (const std::size_t joint : joints) {
    if (!gains_[joint].enabled) {
      status = oGAIN_DISABLED;
      continue;
    }
    gains_[joint].gain = gain;
    gains_[joint].changedGain = true;
  }
  return status;
}

OStatus Services::registerDefaultGain(OPrimitiveID id, const JointGain& gain) {
  const auto joints = jointsOf(id);
  if (joints.empty() && id != oprimitiveID_UNDEF) return oINVALID_PRIMITIVE_ID;
  for (const std::size_t joint : joints) gains_[joint].byDefault = gain;
  return oSUCCESS;
}

OStatus Services::applyDefaultGain(OPrimitiveID id) {
  const auto joints = jointsOf(id);
  if (joints.empty() && id != oprimitiveID_UNDEF) return oINVALID_PRIMITIVE_ID;
  OStatus status = oSUCCESS;
  for (const std::size_t joint : joints) {
    if (!gains_[joint].enabled) {
      status = oGAIN_DISABLED;
      continue;
    }
    gains_[joint].gain = gains_[joint].byDefault;
    gains_[joint].changedGain = true;
  }
  return status;
}

OStatus Services::gain(OPrimitiveID id, bool byDefault, JointGain* gain) const {
  const auto joints = jointsOf(id);
  if (joints.empty() || id == oprimitiveID_UNDEF) return oINVALID_PRIMITIVE_ID;
  *gain = byDefault ? gains_[joints[0]].byDefault : gains_[joints[0]].gain;
  return oSUCCESS;
}

OStatus Services::jointValue(OPrimitiveID id, OJointValue* value) const {
  const Primitives::Place* place = primitives.find(id);
  if (place == nullptr || place->kind != Primitives::Of::joint) return oINVALID_PRIMITIVE_ID;
  *value = jointReading(place->place);
  return oSUCCESS;
}

OStatus Services::sensorValue(OPrimitiveID id, OSensorValue* value) const {
  const Primitives::Place* place = primitives.find(id);
  if (place == nullptr || (place->kind != Primitives::Of::sensor && place->kind != Primitives::Of::joint))
    return oINVALID_PRIMITIVE_ID;
  *value = readingOf({place->kind, place->place, id, odataUNDEF});
  return oSUCCESS;
}

OStatus Services::control(OPrimitiveID id, OPrimitiveRequest request, void* param, std::size_t paramSize, void* result,
                          std::size_t resultSize) {
  const Primitives::Place* place = primitives.find(id);
  if (place == nullptr) return oINVALID_PRIMITIVE_ID;
  const auto kind = place->primitive.kind;
  const bool speaker = kind == Primitive::Kind::speaker, camera = kind == Primitive::Kind::camera,
             joint = place->kind == Primitives::Of::joint, lamp = place->kind == Primitives::Of::lamp;
  OPrimitiveControl_CameraParam cameraParam;
  switch (request) {
    case oprmreqSPEAKER_MUTE_ON:
    case oprmreqSPEAKER_MUTE_OFF:
      if (!speaker) return oINVALID_REQUEST;
      speaker_->setMuted(request == oprmreqSPEAKER_MUTE_ON);
      return oSUCCESS;
    case oprmreqSPEAKER_SET_VOLUME: {
      OPrimitiveControl_SpeakerVolume volume;
      if (!speaker) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, volume)) return oINVALID_ARG;
      speaker_->setVolume(volume.volume);
      return oSUCCESS;
    }
    case oprmreqSPEAKER_SET_SOUND_TYPE: {
      OPrimitiveControl_SpeakerSoundType type;
      if (!speaker) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, type)) return oINVALID_ARG;
      return speaker_->setType(type.type);
    }
    case oprmreqSPEAKER_GET_SOUND_TYPE:
      if (!speaker) return oINVALID_REQUEST;
      return give(OPrimitiveControl_SpeakerSoundType(speaker_->type()), result, resultSize);
    case oprmreqSPEAKER_SET_VOLUME_MIDI:
    case oprmreqSPEAKER_MASTER_TUNING_MIDI:
      return speaker ? oSUCCESS : oINVALID_REQUEST;
    case oprmreqMIC_UNI:
    case oprmreqMIC_OMNI:
    case oprmreqMIC_ALC_ON:
    case oprmreqMIC_ALC_OFF:
      return kind == Primitive::Kind::microphone ? oSUCCESS : oINVALID_REQUEST;
    case oprmreqCAM_SET_WHITE_BALANCE:
    case oprmreqCAM_SET_GAIN:
    case oprmreqCAM_SET_SHUTTER_SPEED:
      if (!camera) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, cameraParam)) return oINVALID_ARG;
      if (cameraParam.camparam < 1 || cameraParam.camparam > 3) return oINVALID_ARG;
      if (request == oprmreqCAM_SET_WHITE_BALANCE) camera_.whiteBalance = cameraParam.camparam;
      if (request == oprmreqCAM_SET_GAIN) camera_.gain = cameraParam.camparam;
      if (request == oprmreqCAM_SET_SHUTTER_SPEED) camera_.shutter = cameraParam.camparam;
      return oSUCCESS;
    case oprmreqCAM_AE_ON:
    case oprmreqCAM_AE_OFF:
    case oprmreqCAM_AWB_ON:
    case oprmreqCAM_AWB_OFF:
      return camera ? oSUCCESS : oINVALID_REQUEST;
    case oprmreqJOINT2_SET_COMMAND: {
      OPrimitiveControl_JointCommandValue2 command;
      if (!joint) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, command)) return oINVALID_ARG;
      effector_->setJoint(place->place, command.command.value);
      return oSUCCESS;
    }
    case oprmreqJOINT2_GET_VALUE: {
      OPrimitiveControl_JointValue value;
      if (!joint) return oINVALID_REQUEST;
      value.jval = jointReading(place->place);
      return give(value, result, resultSize);
    }
    case oprmreqJOINT4_SET_COMMAND: {
      OPrimitiveControl_JointCommandValue4 command;
      if (!joint) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, command)) return oINVALID_ARG;
      effector_->setJoint(place->place, command.command.value == ojoint4_STATE1 ? place->primitive.high : 0);
      return oSUCCESS;
    }
    case oprmreqLED2_SET_COMMAND: {
      OPrimitiveControl_LEDCommandValue2 command;
      if (!lamp) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, command)) return oINVALID_ARG;
      effector_->setLamp(place->place, command.command.led == oledOFF ? 0 : 255, oled3_MODE_UNDEF);
      return oSUCCESS;
    }
    case oprmreqLED3_SET_COMMAND: {
      OPrimitiveControl_LEDCommandValue3 command;
      if (!lamp) return oINVALID_REQUEST;
      if (!takeParam(param, paramSize, command)) return oINVALID_ARG;
      effector_->setLamp(place->place, command.command.intensity, command.command.mode);
      return oSUCCESS;
    }
    default:
      return oNOT_SUPPORTED;
  }
}

OStatus Services::setColours(MemoryRegionID id) {
  const RegionMemory memory = regionMemory(id);
  if (memory.address == nullptr || memory.size < sizeof(OCdtVectorData)) return oINVALID_DATA_VECTOR_ID;
  auto* vector = static_cast<OCdtVectorData*>(memory.address);
  for (longword i = 0; i < std::min<longword>(vector->vectorInfo.numData, ocdtNUM_CHANNELS); ++i) {
    const OCdtInfo& info = vector->info[i];
    for (std::size_t channel = 0; channel < 8; ++channel)
      if (info.channel == (1u << channel)) std::copy(info.table, info.table + 32, colours_[channel].begin());
  }
  return oSUCCESS;
}

}  // namespace btr::openr
