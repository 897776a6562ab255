#pragma once
#include <OPENR/ODataFormats.h>
#include <OPENR/OPower.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OSubject.h>
#include <OPENR/OTime.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/openr/robot_link.h"
#include "core/openr/runtime/objects/region_pool.h"
#include "core/openr/runtime/robot/effector.h"
#include "core/openr/runtime/robot/image_layers.h"
#include "core/openr/runtime/robot/primitives.h"
#include "core/openr/runtime/robot/sound_out.h"
#include "core/openr/runtime/robot/timers.h"
#include "core/openr/runtime/robot/vector_player.h"

namespace btr::openr {

class IpStack;
class System;
struct RunningObject;

/// The robot's own objects, OVirtualRobotComm and OVirtualRobotAudioComm, and what the calls of OPENR:: act on.
class Services {
 public:
  explicit Services(System& system);
  ~Services();

  void sense();                  ///< publishes what the new frame brings
  void begin();                  ///< wants the first vectors; all is connected
  void act(OrderFrame& orders);  ///< plays one frame
  void finish();                 ///< of the program

  const Primitives primitives;
  SyncKeys keys;
  Timers timers;
  IpStack& ip() { return *ip_; }

  // Joints
  OStatus openPrimitive(const std::string& locator, OPrimitiveID* id);
  OStatus closePrimitive(OPrimitiveID id);
  OStatus enableGain(OPrimitiveID id, bool enabled);
  OStatus setGain(OPrimitiveID id, const JointGain& gain);
  OStatus registerDefaultGain(OPrimitiveID id, const JointGain& gain);
  OStatus applyDefaultGain(OPrimitiveID id);
  OStatus gain(OPrimitiveID id, bool byDefault, JointGain* gain) const;
  OStatus jointValue(OPrimitiveID id, OJointValue* value) const;
  OStatus sensorValue(OPrimitiveID id, OSensorValue* value) const;
  OStatus control(OPrimitiveID id, OPrimitiveRequest request, void* param, std::size_t paramSize, void* result,
                  std::size_t resultSize);
  OStatus setColours(MemoryRegionID vector);

  // Power and time
  void setMotorPower(bool on);
  OPowerStatus powerStatus() const;
  OStatus observePower(const OPowerStatus& wanted, const OServiceEntry& entry);
  OStatus unobservePower(const OServiceEntry& entry);
  int volume() const { return volume_; }
  void setVolume(int volume) { volume_ = volume; }
  OTime time() const;
  void setTime(const OTime& time);
  sbyte timeDifference() const { return timeDifference_; }
  void setTimeDifference(sbyte hours) { timeDifference_ = hours; }

  // Design data
  OStatus findDesignData(const std::string& keyword, ODesignDataID* id, byte** data, std::size_t* size);
  OStatus keepDesignData(std::vector<char> content, ODesignDataID* id, byte** data, std::size_t* size);
  OStatus deleteDesignData(ODesignDataID id);

  static constexpr std::int64_t epoch_s = 1072915200;     ///< the robot is switched on at 2004-01-01 00:00:00 UTC
  static constexpr std::int64_t startYear_s = 946684800;  ///< 2000-01-01, from which OTime counts

 private:
  struct InVector {
    Primitives::Of kind;
    std::size_t place;
    OPrimitiveID id;
    ODataType type;
  };
  struct Gain {
    JointGain gain{}, byDefault{};
    bool enabled = false, changedGain = false, changedEnabled = true;
  };
  struct PowerWatch {
    OPowerStatus wanted;
    OServiceEntry entry;
    OPowerStatus seen;  ///< when it began to watch, then in each frame
  };

  void handleRobot(Selector selector, void* message);
  void handleAudio(Selector selector, void* message);
  void readFrame();
  void publishSensors();
  void publishImage();
  void publishMicrophone();
  void watchPower();
  std::vector<std::size_t> jointsOf(OPrimitiveID id) const;
  OSensorValue readingOf(const InVector& item) const;
  OJointValue jointReading(std::size_t joint) const;

  System& system_;
  std::unique_ptr<IpStack> ip_;
  OServiceEntry effectorID_, speakerID_;
  std::unique_ptr<OSubject> sensors_, images_, microphone_;
  std::unique_ptr<Effector> effector_;
  std::unique_ptr<SoundOut> speaker_;
  RegionPool sensorPool_, imagePool_, microphonePool_;
  std::vector<InVector> inVector_;
  std::vector<std::vector<OSensorValue>> frames_;  ///< of the vector that is being filled
  std::uint32_t firstFrame_ = 1;
  int microphoneFrames_ = 0;
  std::vector<std::int32_t> values_;  ///< of the sensors, repeated where they have no new one
  std::vector<bool> fresh_;
  ColourTables colours_{};
  word field_ = 0;
  std::set<OPrimitiveID> opened_;
  std::vector<Gain> gains_;
  bool motorPower_ = false, motorPowerChanged_ = true;
  CameraOrder camera_{};
  std::vector<PowerWatch> watches_;
  int volume_ = -1;
  std::int64_t clockOffset_s_ = 0;
  sbyte timeDifference_ = 0;
  std::map<ODesignDataID, std::vector<char>> designData_;
  ODesignDataID nextDesignData_ = 1;
};

}  // namespace btr::openr
