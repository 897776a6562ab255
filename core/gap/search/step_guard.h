#pragma once

namespace btr {

/// Changes a step for as long as the guard lives: its end, by an exception too, puts back what was there before, unless
/// the step is to stay.
class [[nodiscard]] StepGuard {
 public:
  /// Keeps a reference to the step [s].
  explicit StepGuard(double& step_s) : step_s_(step_s), before_s_(step_s) {}
  StepGuard(double& step_s, double now_s) : StepGuard(step_s) { set(now_s); }
  ~StepGuard() {
    if (!stays_) step_s_ = before_s_;
  }
  StepGuard(const StepGuard&) = delete;
  StepGuard& operator=(const StepGuard&) = delete;

  void set(double step_s) { step_s_ = step_s; }
  /// The step stays as it is when the guard ends.
  void keep() { stays_ = true; }
  double before_s() const { return before_s_; }

 private:
  double& step_s_;
  double before_s_;
  bool stays_ = false;
};

}  // namespace btr
