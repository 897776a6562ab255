#pragma once
#include <memory>
#include <span>

#include "core/sim/world.h"
#include "tests/rival/mjcf.h"

namespace btr::rival {

/// A scene's first robot and its balls in MuJoCo: the same bodies, drives' laws and joint effects as in our World, but
/// its own contacts, its own integrator, its own dry friction, its own joint stops.
class MujocoWorld {
 public:
  /// Throws std::runtime_error with MuJoCo's message if it refuses the model.
  explicit MujocoWorld(const Scene& scene, const MjcfOptions& options = {"implicit", true, 10, true});
  ~MujocoWorld();
  MujocoWorld(const MujocoWorld&) = delete;
  MujocoWorld& operator=(const MujocoWorld&) = delete;

  /// Joints at these positions (by joint of the model), everything at rest where the scene has it.
  void start(std::span<const double> positions);
  /// Advances by a time with inputs held (by joint of the model), in steps of about the scene's.
  void advance(const std::vector<JointInput>& inputs, double duration);

  double time() const;
  /// A state that MuJoCo itself calls bad.
  bool failed() const;
  Eigen::Isometry3d base() const;
  double position(std::size_t joint) const;  ///< true, not what a sensor says; 0 of a fixed joint
  double rate(std::size_t joint) const;
  /// Through the joint's sensor effects; `dt` since it was read last.
  double measured(std::size_t joint, double dt);
  BallState ball(std::size_t index) const;
  /// Whether anything but the floor touches it.
  bool ballTouched(std::size_t index) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::rival
