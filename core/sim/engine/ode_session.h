#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace btr {

/// ODE gave up in the middle of a step (its error and debug handlers end here instead of ending the process).
class OdeFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Starts ODE in this thread. Throws std::runtime_error where its results would not be ours; see requireLcpHook().
void requireOde();

/// Owns one dWorld and what surrounds it: ODE's start (once a process and thread), its random seed, its threading
/// object (ODE's default one is shared, and a step that was left by an error would spoil it for the next world) and its
/// contacts. Throws std::logic_error if another session lives in this process, and what
/// requireOde() does.
class OdeSession {
 public:
  explicit OdeSession(std::uint64_t seed);
  ~OdeSession();
  OdeSession(const OdeSession&) = delete;
  OdeSession& operator=(const OdeSession&) = delete;

  dWorldID world() const { return world_; }
  dJointGroupID contacts() const { return contacts_; }
  /// One dWorldStep. Throws OdeFailure if ODE raises an error; the world must not be stepped again then.
  void step(double duration);

 private:
  dWorldID world_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  dThreadingImplementationID threading_ = nullptr;
  bool broken_ = false;
};

}  // namespace btr
