#include "core/openr/runtime/robot/effector.h"

#include <algorithm>
#include <cstring>

namespace btr::openr {
namespace {

template <class T>
T as(const OCommandValue& value) {
  static_assert(sizeof(T) == sizeof(OCommandValue));
  T result;
  std::memcpy(static_cast<void*>(&result), &value, sizeof(T));
  return result;
}

}  // namespace

bool Effector::readTrack(const OCommandInfo& info, const OCommandValue* values, Track& track,
                         std::size_t& length) const {
  const Primitives::Place* place = primitives_.find(info.primitiveID);
  if (place == nullptr || (place->kind != Primitives::Of::joint && place->kind != Primitives::Of::lamp)) return false;
  track.ofJoint = place->kind == Primitives::Of::joint;
  track.place = place->place;
  const std::int32_t high = track.ofJoint ? design_.joints[track.place].high : 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < info.numFrames; ++i) {
    std::int32_t value = 0;
    std::uint16_t mode = oled3_MODE_UNDEF;
    std::size_t period = 1;
    if (track.ofJoint) {
      if (info.type == odataJOINT_COMMAND2) {
        value = as<OJointCommandValue2>(values[i]).value;
      } else if (info.type == odataJOINT_COMMAND3) {
        value = as<OJointCommandValue3>(values[i]).value == ojoint3_STATE1 ? high : 0;
      } else if (info.type == odataJOINT_COMMAND4) {
        const auto command = as<OJointCommandValue4>(values[i]);
        value = command.value == ojoint4_STATE1 ? high : 0;
        period = command.period;
      } else {
        return false;
      }
    } else if (info.type == odataLED_COMMAND2) {
      const auto command = as<OLEDCommandValue2>(values[i]);
      value = command.led == oledOFF ? 0 : 255;
      period = command.period;
    } else if (info.type == odataLED_COMMAND3) {
      const auto command = as<OLEDCommandValue3>(values[i]);
      value = command.intensity;
      mode = command.mode;
      period = command.period;
    } else {
      return false;
    }
    track.steps.push_back({at, value, mode});
    at += std::max<std::size_t>(period, 1);
  }
  length = std::max(length, at);
  return true;
}

bool Effector::read(Vector& vector) {
  auto* data = reinterpret_cast<OCommandVectorData*>(vector.region->Base());
  const std::size_t size = vector.region->Size();
  vector.wait = data->vectorInfo.wait;
  vector.key = data->vectorInfo.syncKey;
  auto content = std::make_shared<Content>();
  const std::size_t optional = std::min<std::size_t>(data->vectorInfo.optSize, odataOPTIONAL_MAX);
  content->optional.assign(data->vectorInfo.optional, data->vectorInfo.optional + optional);
  std::size_t length = 1;
  const std::size_t infos = (size - sizeof(ODataVectorInfo)) / sizeof(OCommandInfo);
  for (std::size_t i = 0; i < std::min<std::size_t>(data->vectorInfo.numData, infos); ++i) {
    const OCommandInfo info = *data->GetInfo(static_cast<int>(i));
    if (info.numFrames > ocommandMAX_FRAMES || info.dataOffset > size ||
        info.numFrames * sizeof(OCommandValue) > size - info.dataOffset)
      continue;
    Track track;
    const auto* values = reinterpret_cast<const OCommandValue*>(vector.region->Base() + info.dataOffset);
    if (readTrack(info, values, track, length)) content->tracks.push_back(std::move(track));
  }
  vector.length = length;
  vector.content = content;
  return true;
}

void Effector::play(const Vector& vector) {
  const auto& content = *std::static_pointer_cast<Content>(vector.content);
  if (vector.frame == 0 && !content.optional.empty()) optional_ = content.optional;
  for (const Track& track : content.tracks)
    for (const Step& step : track.steps) {
      if (step.begin != vector.frame) continue;
      if (track.ofJoint)
        setJoint(track.place, step.value);
      else
        setLamp(track.place, step.value, step.mode);
    }
}

void Effector::setJoint(std::size_t joint, std::int32_t value_urad) {
  targets_[joint] = std::clamp(value_urad, design_.joints[joint].low, design_.joints[joint].high);
}

void Effector::setLamp(std::size_t lamp, int intensity, std::uint16_t mode) {
  constexpr int typeWithSteps = 16;  // oprimitiveLED3
  const int shown =
      design_.lamps[lamp].openrType == typeWithSteps ? std::clamp(intensity, 0, 255) : (intensity > 0 ? 255 : 0);
  Lamp& old = lamps_[lamp];
  if (old.intensity == shown && old.mode == mode) return;
  old = {shown, mode, true};
}

void Effector::addTo(OrderFrame& orders) {
  if (!targets_.empty()) orders.joints.resize(design_.joints.size());
  for (const auto& [joint, value] : targets_) orders.joints[joint].target_urad = value;
  targets_.clear();
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    if (!lamps_[i].changed) continue;
    lamps_[i].changed = false;
    orders.lamps.push_back(
        {static_cast<std::uint16_t>(i), static_cast<std::uint8_t>(lamps_[i].intensity), lamps_[i].mode});
  }
}

}  // namespace btr::openr
