// Built where MuJoCo is not installed.
#include "core/spec/error.h"
#include "tests/prove/reality.h"

namespace btr::prove {

bool hasMujoco() { return false; }

Truth simulateMujoco(const Scene&, const TrialPlan&, const std::vector<MeasuredColumn>&) {
  throw InputError("--engine mujoco: this program was built without MuJoCo; install libmujoco-dev and build again");
}

}  // namespace btr::prove
