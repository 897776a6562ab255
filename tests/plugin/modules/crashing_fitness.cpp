// A fitness that crashes in the way that its setting says.
#include <csignal>
#include <cstdlib>

#include "core/plugin/plugin.h"

namespace {

class CrashingFitness final : public btr::Fitness {
  std::string unit() const override { return "m"; }
  std::string meaning() const override { return "nothing"; }
  std::vector<btr::Parameter> settings() const override {
    return {{"how", "", "how it crashes", 0, 2, 0, {}, false, {"bad_address", "abort", "endless_recursion"}}};
  }
  double evaluate(const btr::TrialResult&, const btr::Values& settings, const btr::Values&) const override {
    const double how = settings.at("how");
    if (how == 0) *address_ = 1;
    if (how == 1) std::abort();
    return deeper(1);
  }
  double deeper(double depth) const {
    volatile char room[4096] = {};
    room[static_cast<std::size_t>(depth) % 4096] = 1;
    return deeper(depth + 1) + room[7];
  }
  volatile int* volatile address_ = nullptr;
};

}  // namespace

BTR_FITNESS(CrashingFitness, "crashing")
