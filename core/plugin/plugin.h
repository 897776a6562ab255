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
#include "core/sim/controller.h"
#include "core/sim/effect.h"
#include "core/sim/fitness.h"
#include "core/sim/gait.h"
#include "core/spec/error.h"

namespace btr {

/// What a plugin module hands to the host when it is loaded. A module registers one thing.
struct PluginRegistry {
  virtual ~PluginRegistry() = default;
  virtual void add(const char* name, std::function<std::unique_ptr<Controller>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Learner>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Fitness>()> make) = 0;
  virtual void add(const char* name, std::function<std::unique_ptr<Effect>()> make) = 0;
};

/// Found by dlsym("btr_plugin"). The host refuses a module whose version or compiler differs from its own.
struct PluginModule {
  int apiVersion;
  const char* compiler;  ///< __VERSION__
  const char* name;
  void (*registerIn)(PluginRegistry&);
};

inline constexpr int pluginApiVersion = 4;

}  // namespace btr

#define BTR_PLUGIN_(Kind, Class, plainName)                                                                    \
  extern "C" {                                                                                                 \
  extern const btr::PluginModule btr_plugin;                                                                   \
  const btr::PluginModule btr_plugin = {                                                                       \
      btr::pluginApiVersion, __VERSION__, plainName, [](btr::PluginRegistry& registry) {                       \
        registry.add(plainName,                                                                                \
                     std::function<std::unique_ptr<btr::Kind>()>([] { return std::make_unique<Class>(); }));   \
      }};                                                                                                      \
  }
/// BTR_EFFECT(StribeckFriction, "stribeck_friction") at the end of a plugin's file makes it known.
#define BTR_EFFECT(Class, plainName) BTR_PLUGIN_(Effect, Class, plainName)
#define BTR_CONTROLLER(Class, plainName) BTR_PLUGIN_(Controller, Class, plainName)
#define BTR_LEARNER(Class, plainName) BTR_PLUGIN_(Learner, Class, plainName)
#define BTR_FITNESS(Class, plainName) BTR_PLUGIN_(Fitness, Class, plainName)
