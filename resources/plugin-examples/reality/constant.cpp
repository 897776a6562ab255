/// A robot that always measures the same value: the smallest reality that answers by itself.
#include "core/plugin/plugin.h"

namespace {

class ConstantRobot final : public btr::RealRobot {
 public:
  explicit ConstantRobot(double value) : value_(value) {}
  std::optional<btr::RealAnswer> measure(const btr::RealTask&) override { return btr::RealAnswer{value_}; }

 private:
  double value_;
};

class Constant final : public btr::Reality {
  std::string meaning() const override { return "Every trial has the same fitness"; }
  std::vector<btr::Parameter> settings() const override {
    return {{"value", "", "the fitness that every trial has", -1000, 1000, 1}};
  }
  std::string who() const override { return "constant"; }
  std::unique_ptr<btr::RealRobot> open(const btr::RealityContext& context) const override {
    return std::make_unique<ConstantRobot>(context.settings.at("value"));
  }
};

}  // namespace

BTR_REALITY(Constant, "constant")
