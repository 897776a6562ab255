#pragma once
#include "core/openr/robot_design.h"
#include "core/openr/robot_link.h"
#include "core/openr/runtime/robot/primitives.h"
#include "core/openr/runtime/robot/vector_player.h"

namespace btr::openr {

/// Commands to joints and lamps.
class Effector : public VectorPlayer {
 public:
  Effector(const ObserverID& id, const RobotDesign& design, const Primitives& primitives, Complain complain)
      : VectorPlayer(id, std::move(complain)), design_(design), primitives_(primitives), lamps_(design.lamps.size()) {}

  /// What the frame that was stepped last asks for, added to `orders`.
  void addTo(OrderFrame& orders);
  /// At once, beside all queues.
  void setJoint(std::size_t joint, std::int32_t value_urad);
  void setLamp(std::size_t lamp, int intensity, std::uint16_t mode);
  /// What came with the vector that began last.
  const std::vector<byte>& optional() const { return optional_; }

 private:
  struct Step {
    std::size_t begin;  ///< frame
    std::int32_t value;
    std::uint16_t mode;
  };
  struct Track {
    bool ofJoint;
    std::size_t place;
    std::vector<Step> steps;
  };
  struct Content {
    std::vector<Track> tracks;
    std::vector<byte> optional;
  };
  struct Lamp {
    int intensity = 0;
    std::uint16_t mode = oled3_MODE_UNDEF;
    bool changed = false;
  };

  bool read(Vector& vector) override;
  void play(const Vector& vector) override;
  void readTrack(const OCommandInfo& info, const OCommandValue* values, Track& track, std::size_t& length) const;
  /// What is wrong with a command; its kind is empty if nothing is.
  struct Wrong {
    std::string kind, what;
  };
  Wrong wrongIn(const OCommandInfo& info, std::size_t size) const;

  const RobotDesign& design_;
  const Primitives& primitives_;
  std::map<std::size_t, std::int32_t> targets_;
  std::vector<Lamp> lamps_;
  std::vector<byte> optional_;
};

}  // namespace btr::openr
