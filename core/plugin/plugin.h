#pragma once
// The one header that a plugin's author includes.
#include <functional>
#include <memory>

#include "core/learn/bit_coding.h"
#include "core/learn/learner.h"
#include "core/learn/policy_gradient.h"
#include "core/learn/selection.h"
#include "core/learn/variation.h"
#include "core/model/kinematics.h"
#include "core/plugin/joint_effect.h"
#include "core/plugin/plugin_build.h"
#include "core/plugin/reality.h"
#include "core/plugin/robot_program.h"
#include "core/sim/controller.h"
#include "core/sim/effect.h"
#include "core/sim/fitness.h"
#include "core/sim/gait.h"
#include "core/spec/csv.h"
#include "core/spec/error.h"

namespace btr {

/// What a plugin module hands to the host when it is loaded. A module registers one thing.
struct PluginRegistry {
  virtual ~PluginRegistry() = default;
  virtual void add(const char* name, std::function<std::unique_ptr<Controller>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Learner>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Fitness>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Effect>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Reality>()> make) = 0;
};

// What an author who says nothing gets; `uchilsim_add_plugin` may define them, and so may the file itself.
#ifndef BTR_PLUGIN_VERSION
#define BTR_PLUGIN_VERSION ""
#endif
#ifndef BTR_PLUGIN_AUTHOR
#define BTR_PLUGIN_AUTHOR ""
#endif
#ifndef BTR_PLUGIN_LICENCE
#define BTR_PLUGIN_LICENCE ""
#endif

/// Who made a plugin; "" where the author does not say.
struct PluginAbout {
  const char* version = BTR_PLUGIN_VERSION;
  const char* author = BTR_PLUGIN_AUTHOR;
  const char* licence = BTR_PLUGIN_LICENCE;
};

/// Found by dlsym("btr_plugin"). The first member stays where it is: modules of every version can be recognised.
struct PluginModule {
  int apiVersion;
  PluginBuild build;
  const char* name;
  PluginAbout about;
  void (*registerIn)(PluginRegistry&);
};

inline constexpr int pluginApiVersion = 12;

/// Changes when a type that passes between plugin and program changes its size.
inline constexpr std::size_t pluginLayout =
    sizeof(Parameter) + 3 * sizeof(JointState) + 5 * sizeof(BallState) + 7 * sizeof(RobotReadings) +
    11 * sizeof(JointInput) + 13 * sizeof(Scene) + 17 * sizeof(SceneRobot) + 19 * sizeof(RobotModel) +
    23 * sizeof(TrialResult) + 29 * sizeof(Candidate) + 31 * sizeof(Random) + 37 * sizeof(RealTask) +
    41 * sizeof(RealityContext) + 43 * sizeof(MotionSenses) + 47 * sizeof(CameraPicture);

}  // namespace btr

#define BTR_PLUGIN_(Kind, Class, plainName, ...)                                                                  \
  extern "C" {                                                                                                    \
  extern const btr::PluginModule btr_plugin;                                                                      \
  const btr::PluginModule btr_plugin = {btr::pluginApiVersion, BTR_PLUGIN_BUILD, plainName,                       \
                                        btr::PluginAbout{__VA_ARGS__}, [](btr::PluginRegistry& registry) {        \
                                          registry.add(plainName, std::function<std::unique_ptr<btr::Kind>()>(    \
                                                                      [] { return std::make_unique<Class>(); })); \
                                        }};                                                                       \
  }
/// BTR_EFFECT(StribeckFriction, "stribeck_friction") at the end of a plugin's file makes it known. After the name may
/// follow who made it: .version = "1.2", .author = "J. Doe", .licence = "MIT".
#define BTR_EFFECT(Class, ...) BTR_PLUGIN_(Effect, Class, __VA_ARGS__)
#define BTR_CONTROLLER(Class, ...) BTR_PLUGIN_(Controller, Class, __VA_ARGS__)
#define BTR_LEARNER(Class, ...) BTR_PLUGIN_(Learner, Class, __VA_ARGS__)
#define BTR_FITNESS(Class, ...) BTR_PLUGIN_(Fitness, Class, __VA_ARGS__)
#define BTR_REALITY(Class, ...) BTR_PLUGIN_(Reality, Class, __VA_ARGS__)
