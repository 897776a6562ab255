// A controller that, after so many seconds of its motion, never answers again, or crashes.
#include <atomic>
#include <chrono>
#include <cstdlib>

#include "core/plugin/plugin.h"

namespace {

class StuckMotion final : public btr::Motion {
 public:
  StuckMotion(double after_s, double pause_s, bool crashes) : after_s_(after_s), pause_s_(pause_s), crashes_(crashes) {}
  void command(double time, const btr::RobotReadings&, std::span<btr::JointInput>) override {
    if (time < after_s_) return;
    if (crashes_) std::abort();
    const auto begin = std::chrono::steady_clock::now();
    while (pause_s_ <= 0 || std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(pause_s_))
      ++spins_;
  }
  double duration() const override { return 1e9; }

 private:
  double after_s_, pause_s_;
  bool crashes_;
  std::atomic<long> spins_{0};
};

class StuckController final : public btr::Controller {
  std::vector<btr::Parameter> genotype() const override {
    return {{"nothing", "", "does nothing", 0, 1, 0, {}, false, {}}};
  }
  std::vector<btr::Parameter> settings() const override {
    return {{"after_s", "s", "when it is stuck", 0, 1e6, 0.1, {}, false, {}},
            {"pause_s", "s", "for how long; 0: for ever", 0, 1e6, 0, {}, false, {}},
            {"how", "", "what it does", 0, 1, 0, {}, false, {"hangs", "crashes"}}};
  }
  void arrange(btr::Scene&, const btr::Values&) const override {}
  std::unique_ptr<btr::Motion> begin(const btr::Scene&, const btr::Values& values,
                                     std::span<const double>) const override {
    const std::vector<btr::Parameter> declared = settings();
    return std::make_unique<StuckMotion>(btr::valueOf(declared, values, "after_s"),
                                         btr::valueOf(declared, values, "pause_s"),
                                         btr::valueOf(declared, values, "how") == 1);
  }
};

}  // namespace

BTR_CONTROLLER(StuckController, "spin")
