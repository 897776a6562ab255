#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "core/spec/parameter.h"

namespace btr {

class World;

/// One of a robot's senses beside the joint positions that its controller reads exactly: see senseNames().
struct SenseSpec {
  std::string sense;
  Values parameters{};  ///< what is left out has its default
  bool operator==(const SenseSpec&) const = default;
};

/// accelerometer, infrared_near, infrared_far, infrared_chest, infrared_head, paws, touch, joints.
const std::vector<std::string>& senseNames();
/// Noise, sample period, delay and bounds of a sense of that name.
const std::vector<Parameter>& senseParameters(const std::string& sense);
/// The senses of a model as its maker gives them: "ers7", "ers210"; throws InputError for another word.
std::vector<SenseSpec> sensesOfModel(const std::string& model, const std::string& place);

/// A point that a hand holds.
struct Touch {
  int link = 0;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< in the link's frame
};

/// What one robot senses: each channel is sampled every so often, held in between, and known some time later. Noise is
/// a function of seed, channel and number of the sample alone, so that nothing but what is on its way must be
/// remembered.
class Senses {
 public:
  /// Throws InputError, beginning with `place`, for a sense that the robot cannot have and for parameters out of
  /// bounds.
  Senses(const std::vector<SenseSpec>& specs, const SceneRobot& robot, std::uint64_t seed, const std::string& place);

  const std::vector<std::string>& channels() const { return names_; }  ///< "red1.accelerometer.x_m_s2" …
  /// The end of control period number `period` (0: the beginning of the game).
  void sense(const World& world, std::size_t robot, const std::vector<Touch>& touches, long period, double period_s);
  /// What is known now, by channel.
  void sample(std::vector<double>& row) const;

  /// By channel what is on its way, the oldest first. Empty before the first sample.
  const std::vector<std::vector<double>>& memory() const { return pending_; }
  /// Throws InputError for what no such senses remember.
  void remember(const std::vector<std::vector<double>>& memory, const std::string& place);

 private:
  enum class Kind { accelerometer, infrared, paws, touch, joints };
  struct Sense {
    Kind kind = Kind::joints;
    std::size_t first = 0, count = 0;  ///< channels
    double noise = 0, period_s = 0, delay_s = 0, lowest = 0, highest = 0, resolution = 0;
    int link = 0;                                     ///< infrared: where it looks from …
    Eigen::Vector3d eye_m = Eigen::Vector3d::Zero();  ///< … in that link's frame
    Eigen::Vector3d look = Eigen::Vector3d::UnitX();  ///< unit
    std::vector<std::size_t> parts{};                 ///< joints of the model
    std::vector<std::vector<std::size_t>> paws{};     ///< by channel, links
  };

  void add(const SenseSpec& spec, const SceneRobot& robot, const std::string& place);
  void truth(const Sense& sense, const World& world, std::size_t robot, const std::vector<Touch>& touches,
             std::vector<double>& values) const;

  std::uint64_t seed_;
  std::vector<Sense> senses_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> pending_;
  int head_ = -1, jaw_ = -1;
};

}  // namespace btr
