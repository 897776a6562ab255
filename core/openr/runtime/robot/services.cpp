#include "core/openr/runtime/robot/services.h"

#include <algorithm>
#include <cstring>

#include "core/openr/runtime/network/ip_stack.h"
#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/vectors.h"

namespace btr::openr {
namespace {

// Entries of the robot's objects.
enum Entries : Selector {
  effectorConnect = 100,
  effectorNotify,
  sensorControl,
  sensorReady,
  imageControl,
  imageReady,
  speakerConnect = 200,
  speakerNotify,
  microphoneControl,
  microphoneReady
};

constexpr std::size_t framesInVector = 4;
constexpr std::size_t vectorsAtOnce = 13;  ///< that Effector and Speaker take in one message [not documented]
constexpr word fullScale = 1023;           ///< of 10 bits

std::string soundFile(const std::string& stick) { return stick + "/SPEAKER.WAV"; }

ODataType typeOf(const Primitive& primitive) {
  if (primitive.kind == Primitive::Kind::joint || primitive.kind == Primitive::Kind::ear) return odataJOINT_VALUE;
  const std::string& name = primitive.name;
  if (name.find("acceleration") == 0) return odataACCELERATION;
  if (name.find("distance") == 0) return odataLENGTH;
  if (name == "temperature") return odataTEMPERATURE;
  if (name.find("paw_") == 0 || name == "wireless_switch" || name.find("chin") != std::string::npos) return odataSWITCH;
  if (name.find("touch_head_") == 0 || name.find("head_lever") == 0) return odataFORCE;
  return odataNO_DIMENSION;
}

word signalOf(const Primitive& primitive, std::int32_t value) {
  const auto scaled = [](double share) { return static_cast<word>(std::clamp(share, 0.0, 1.0) * fullScale); };
  switch (typeOf(primitive)) {
    case odataJOINT_VALUE:
      return scaled((value - primitive.low) / std::max(1.0, static_cast<double>(primitive.high) - primitive.low));
    case odataACCELERATION:
      return scaled(0.5 + value / 39226600.0);  // ±19.6133 m/s²
    case odataLENGTH:
      return scaled(1.0 - value / 1500000.0);  // near is a strong echo
    case odataFORCE:
      return scaled(value / 980665.0);
    case odataTEMPERATURE:
      return static_cast<word>(value / 1000000);
    default:
      return static_cast<word>(value);
  }
}

}  // namespace

Services::Services(System& system) : primitives(system.design), system_(system), gains_(system.design.joints.size()) {
  ip_ = std::make_unique<IpStack>(system);
  for (std::size_t i = 0; i < gains_.size(); ++i)  // an ear has a plunger, no servo
    gains_[i].changedEnabled = system.design.joints[i].kind == Primitive::Kind::joint;
  for (auto& channel : colours_) channel.fill(ocdtINIT);
  values_.resize(system.design.sensors.size());
  fresh_.resize(system.design.sensors.size());
  RunningObject& robot = system.addNative("OVirtualRobotComm", [this](Selector s, void* m) { handleRobot(s, m); });
  RunningObject& audio = system.addNative("OVirtualRobotAudioComm", [this](Selector s, void* m) { handleAudio(s, m); });

  effectorID_ = OServiceEntry(robot.oid, effectorNotify);
  speakerID_ = OServiceEntry(audio.oid, speakerNotify);
  const auto complain = [&system](const SubjectID& from, const std::string& kind, const std::string& text) {
    system.sayOnce(system.objectOf(from.oid), kind, text);
  };
  effector_ = std::make_unique<Effector>(effectorID_, system.design, primitives, complain);
  speaker_ = std::make_unique<SoundOut>(speakerID_, soundFile(system.stick), complain);
  system.bufferControl[effectorID_] = system.bufferControl[speakerID_] = {0, 1, vectorsAtOnce};
  robot.observers.push_back(
      {"OVirtualRobotComm.Effector.OCommandVectorData.O", OServiceEntry(robot.oid, effectorConnect)});
  robot.notifyEntries.push_back(effectorID_);
  audio.observers.push_back(
      {"OVirtualRobotAudioComm.Speaker.OSoundVectorData.O", OServiceEntry(audio.oid, speakerConnect)});
  audio.notifyEntries.push_back(speakerID_);

  const auto addSubject = [](RunningObject& object, const char* name, Selector control, Selector ready) {
    auto subject = std::make_unique<OSubject>();
    subject->SetReadyEntry(OServiceEntry(object.oid, ready));
    object.subjects.push_back({name, OServiceEntry(object.oid, control)});
    return subject;
  };
  sensors_ = addSubject(robot, "OVirtualRobotComm.Sensor.OSensorFrameVectorData.S", sensorControl, sensorReady);
  images_ = addSubject(robot, "OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S", imageControl, imageReady);
  microphone_ = addSubject(audio, "OVirtualRobotAudioComm.Mic.OSoundVectorData.S", microphoneControl, microphoneReady);

  for (const std::string& locator : system.design.sensorVector) {
    const OPrimitiveID id = primitives.at(locator);
    const Primitives::Place* place = primitives.find(id);
    if (place != nullptr) inVector_.push_back({place->kind, place->place, id, typeOf(place->primitive)});
  }
}

Services::~Services() = default;

void Services::handleRobot(Selector selector, void* message) {
  switch (selector) {
    case effectorConnect:
      effector_->connect(static_cast<OConnectMessage*>(message)->subject);
      break;
    case effectorNotify:
      effector_->take(*static_cast<ONotifyMessage*>(message));
      break;
    case sensorControl:
      sensors_->ControlHandler(static_cast<OControlMessage*>(message));
      break;
    case sensorReady:
      sensors_->ReadyHandler(static_cast<OReadyMessage*>(message));
      break;
    case imageControl:
      images_->ControlHandler(static_cast<OControlMessage*>(message));
      break;
    case imageReady:
      images_->ReadyHandler(static_cast<OReadyMessage*>(message));
      break;
    default:
      break;
  }
}

void Services::handleAudio(Selector selector, void* message) {
  switch (selector) {
    case speakerConnect:
      speaker_->connect(static_cast<OConnectMessage*>(message)->subject);
      break;
    case speakerNotify:
      speaker_->take(*static_cast<ONotifyMessage*>(message));
      break;
    case microphoneControl:
      microphone_->ControlHandler(static_cast<OControlMessage*>(message));
      break;
    case microphoneReady:
      microphone_->ReadyHandler(static_cast<OReadyMessage*>(message));
      break;
    default:
      break;
  }
}

void Services::begin() {
  effector_->begin();
  speaker_->begin();
}

// ---- senses -----------------------------------------------------------------------------------------------------

void Services::sense() {
  readFrame();
  ip_->poll();
  timers.send(system_);
  watchPower();
  publishMicrophone();
  publishSensors();
  publishImage();
}

/// The distance sensors of the ERS-7's head take turns, frame by frame.
void Services::readFrame() {
  const SensorFrame& frame = system_.sensed();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::string& name = system_.design.sensors[i].name;
    const bool odd = frame.number % 2 == 1;
    fresh_[i] = name == "distance_near" ? odd : (name == "distance_far" ? !odd : true);
    if (fresh_[i] || values_[i] == 0) values_[i] = frame.sensors[i];
  }
  if (volume_ < 0) volume_ = frame.power.volume;
}

OJointValue Services::jointReading(std::size_t joint) const {
  const JointReading& reading = system_.sensed().joints[joint];
  const Primitive& primitive = system_.design.joints[joint];
  return OJointValue(reading.value_urad, signalOf(primitive, reading.value_urad), reading.duty, reading.reference_urad,
                     signalOf(primitive, reading.reference_urad));
}

OSensorValue Services::readingOf(const InVector& item) const {
  OSensorValue value{};
  if (item.kind == Primitives::Of::joint) {
    const OJointValue joint = jointReading(item.place);
    static_assert(sizeof(joint) == sizeof(value));
    std::memcpy(static_cast<void*>(&value), static_cast<const void*>(&joint), sizeof(value));
    return value;
  }
  value.value = values_[item.place];
  value.signal = fresh_[item.place] ? signalOf(system_.design.sensors[item.place], value.value) : word{0};
  return value;
}

void Services::publishSensors() {
  if (frames_.empty()) firstFrame_ = system_.sensed().number;
  std::vector<OSensorValue> now;
  now.reserve(inVector_.size());
  for (const InVector& item : inVector_) now.push_back(readingOf(item));
  frames_.push_back(std::move(now));
  if (frames_.size() < framesInVector) return;
  if (sensors_->NumberOfObservers() > 0) {
    RCRegion* region = sensorPool_.take(sensorVectorBytes(inVector_.size()));
    auto* vector = reinterpret_cast<OSensorFrameVectorData*>(region->Base());
    initSensorVector(vector, region->MemID(), inVector_.size());
    vector->SetNumData(inVector_.size());
    const auto& optional = effector_->optional();
    vector->vectorInfo.optSize = static_cast<longword>(optional.size());
    std::copy(optional.begin(), optional.end(), vector->vectorInfo.optional);
    for (std::size_t i = 0; i < inVector_.size(); ++i) {
      OSensorFrameInfo* info = vector->GetInfo(static_cast<int>(i));
      info->Set(inVector_[i].type, inVector_[i].id, framesInVector);
      info->frameNumber = firstFrame_;
      for (std::size_t f = 0; f < framesInVector; ++f) vector->GetData(static_cast<int>(i))->frame[f] = frames_[f][i];
    }
    sensors_->SetData(region);
    sensors_->NotifyObservers();
  }
  frames_.clear();
}

void Services::publishImage() {
  const auto& image = system_.sensed().image;
  if (!image) return;
  ++field_;
  if (images_->NumberOfObservers() == 0) return;
  const std::size_t width = system_.design.imageWidth, height = system_.design.imageHeight;
  RCRegion* region = imagePool_.take(imageVectorBytes(width, height));
  auto* vector = reinterpret_cast<OFbkImageVectorData*>(region->Base());
  initImageVector(vector, region->MemID(), width, height);
  vector->SetPrimitiveID(primitives.idOf(Primitive::Kind::camera));
  for (int layer = 0; layer < 4; ++layer) vector->GetInfo(layer)->frameNumber = system_.sensed().number;
  fillLayers(vector, *image, colours_, field_);
  images_->SetData(region);
  images_->NotifyObservers();
}

/// Silence, 16 kHz, 16 bits, stereo.
void Services::publishMicrophone() {
  const int frames = system_.design.name == "ERS-7" ? 2 : 4;
  if (++microphoneFrames_ < frames) return;
  microphoneFrames_ = 0;
  if (microphone_->NumberOfObservers() == 0) return;
  const std::size_t bytes = static_cast<std::size_t>(frames) * 8 * 16 * 4;
  RCRegion* region = microphonePool_.take(soundVectorBytes(1, bytes));
  auto* vector = reinterpret_cast<OSoundVectorData*>(region->Base());
  initSoundVector(vector, region->MemID(), 1, bytes);
  vector->SetNumData(1);
  OSoundInfo* info = vector->GetInfo(0);
  info->Set(odataSOUND, primitives.idOf(Primitive::Kind::microphone), bytes);
  info->frameNumber = system_.sensed().number - static_cast<std::uint32_t>(frames) + 1;
  info->frameSize = 4;
  info->format = osoundformatPCM;
  info->channel = osoundchannelSTEREO;
  info->samplingRate = 16000;
  info->bitsPerSample = 16;
  info->actualDataSize = static_cast<longword>(bytes);
  microphone_->SetData(region);
  microphone_->NotifyObservers();
}

// ---- orders -----------------------------------------------------------------------------------------------------

void Services::act(OrderFrame& orders) {
  std::set<OVRSyncKey> waiting;
  effector_->addWaiting(waiting, keys);
  speaker_->addWaiting(waiting, keys);
  const std::set<OVRSyncKey> starting = keys.takeComplete(waiting);
  speaker_->setTime(system_.time_us());
  effector_->step(starting, keys);
  speaker_->step(starting, keys);
  effector_->addTo(orders);
  for (std::size_t i = 0; i < gains_.size(); ++i) {
    Gain& gain = gains_[i];
    if (!gain.changedGain && !gain.changedEnabled) continue;
    orders.joints.resize(gains_.size());
    if (gain.changedGain) orders.joints[i].gain = gain.gain;
    if (gain.changedEnabled) orders.joints[i].gainEnabled = gain.enabled;
    gain.changedGain = gain.changedEnabled = false;
  }
  if (motorPowerChanged_) orders.motorPower = motorPower_;
  motorPowerChanged_ = false;
  orders.camera = camera_;
  camera_ = {};
}

void Services::finish() {
  const std::string file = speaker_->close();
  if (!file.empty()) system_.say("", "what the loudspeaker played stands in " + file);
  ip_->closeAll();
}

}  // namespace btr::openr
