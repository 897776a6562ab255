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

bool isJointType(ODataType type) {
  return type == odataJOINT_COMMAND2 || type == odataJOINT_COMMAND3 || type == odataJOINT_COMMAND4;
}

bool isLampType(ODataType type) { return type == odataLED_COMMAND2 || type == odataLED_COMMAND3; }

std::string nameOf(ODataType type) {
  switch (type) {
    case odataUNDEF:
      return "odataUNDEF";
    case odataJOINT_COMMAND2:
      return "odataJOINT_COMMAND2";
    case odataJOINT_COMMAND3:
      return "odataJOINT_COMMAND3";
    case odataJOINT_COMMAND4:
      return "odataJOINT_COMMAND4";
    case odataLED_COMMAND2:
      return "odataLED_COMMAND2";
    case odataLED_COMMAND3:
      return "odataLED_COMMAND3";
    default:
      return "the type " + std::to_string(type);
  }
}

}  // namespace

Effector::Wrong Effector::wrongIn(const OCommandInfo& info, std::size_t size) const {
  const Primitives::Place* place = primitives_.find(info.primitiveID);
  if (place == nullptr) {
    const std::string id =
        info.primitiveID == oprimitiveID_UNDEF ? "oprimitiveID_UNDEF" : std::to_string(info.primitiveID);
    return {"primitiveID", "the primitiveID " + id + ": the " + design_.name + " has none of that number"};
  }
  const std::string& name = place->primitive.name;
  const bool joint = place->kind == Primitives::Of::joint;
  if (!joint && place->kind != Primitives::Of::lamp)
    return {"primitive", "the primitiveID of " + name + ", which is neither a joint nor a lamp"};
  if (joint && !isJointType(info.type))
    return {"type", nameOf(info.type) + " for the joint " + name + ": odataJOINT_COMMAND2, 3 or 4 is allowed"};
  if (!joint && !isLampType(info.type))
    return {"type", nameOf(info.type) + " for the lamp " + name + ": odataLED_COMMAND2 or 3 is allowed"};
  if (info.numFrames < 1 || info.numFrames > ocommandMAX_FRAMES)
    return {"numFrames", "numFrames " + std::to_string(info.numFrames) + " for " + name + ": 1 to " +
                             std::to_string(ocommandMAX_FRAMES) + " are allowed"};
  if (info.dataOffset > size || info.numFrames * sizeof(OCommandValue) > size - info.dataOffset)
    return {"dataOffset", "data of " + name + " that lie outside of its region"};
  return {};
}

void Effector::readTrack(const OCommandInfo& info, const OCommandValue* values, Track& track,
                         std::size_t& length) const {
  const Primitives::Place& place = *primitives_.find(info.primitiveID);
  track.ofJoint = place.kind == Primitives::Of::joint;
  track.place = place.place;
  const std::int32_t high = track.ofJoint ? design_.joints[track.place].high : 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < info.numFrames; ++i) {
    std::int32_t value = 0;
    std::uint16_t mode = oled3_MODE_UNDEF;
    std::size_t period = 1;
    if (info.type == odataJOINT_COMMAND2) {
      value = as<OJointCommandValue2>(values[i]).value;
    } else if (info.type == odataJOINT_COMMAND3) {
      value = as<OJointCommandValue3>(values[i]).value == ojoint3_STATE1 ? high : 0;
    } else if (info.type == odataJOINT_COMMAND4) {
      const auto command = as<OJointCommandValue4>(values[i]);
      value = command.value == ojoint4_STATE1 ? high : 0;
      period = command.period;
    } else if (info.type == odataLED_COMMAND2) {
      const auto command = as<OLEDCommandValue2>(values[i]);
      value = command.led == oledOFF ? 0 : 255;
      period = command.period;
    } else {
      const auto command = as<OLEDCommandValue3>(values[i]);
      value = command.intensity;
      mode = command.mode;
      period = command.period;
    }
    track.steps.push_back({at, value, mode});
    at += std::max<std::size_t>(period, 1);
  }
  length = std::max(length, at);
}

bool Effector::read(Vector& vector) {
  auto* data = reinterpret_cast<OCommandVectorData*>(vector.region->Base());
  const std::size_t size = vector.region->Size();
  const ODataVectorInfo& head = data->vectorInfo;
  if (head.type != odataCOMMAND_VECTOR && head.type != odataUNDEF) {
    complain_(vector.from, "vector",
              "what was sent to the Effector is no command vector (type " + std::to_string(head.type) +
                  "): OPENR::NewCommandVectorData makes one");
    return false;
  }
  vector.wait = head.wait;
  vector.key = head.syncKey;
  auto content = std::make_shared<Content>();
  const std::size_t optional = std::min<std::size_t>(head.optSize, odataOPTIONAL_MAX);
  content->optional.assign(head.optional, head.optional + optional);
  std::size_t length = 1;
  std::size_t most = (size - sizeof(ODataVectorInfo)) / sizeof(OCommandInfo);
  if (head.maxNumData > 0) most = std::min<std::size_t>(most, head.maxNumData);
  if (head.numData > most)
    complain_(vector.from, "numData",
              "a command vector has numData " + std::to_string(head.numData) + ", but room for " +
                  std::to_string(most) + ": the others are left out");
  for (std::size_t i = 0; i < std::min<std::size_t>(head.numData, most); ++i) {
    const OCommandInfo info = *data->GetInfo(static_cast<int>(i));
    const bool asItWasMade = info.type == odataUNDEF && info.primitiveID == oprimitiveID_UNDEF;
    if (asItWasMade) continue;
    if (const Wrong wrong = wrongIn(info, size); !wrong.kind.empty()) {
      complain_(vector.from, wrong.kind, "a command was left out, which has " + wrong.what);
      continue;
    }
    Track track;
    readTrack(info, reinterpret_cast<const OCommandValue*>(vector.region->Base() + info.dataOffset), track, length);
    content->tracks.push_back(std::move(track));
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
