/// Another program measures, a robot's own computer in the lab, say: it asks the open interface (btr serve) what to
/// measure and sends the values.
#include "core/plugin/plugin.h"

namespace {

class Remote final : public btr::Reality {
  std::string meaning() const override {
    return "Another program measures and sends the values over the open interface";
  }
  std::string who() const override { return "remote"; }
  std::unique_ptr<btr::RealRobot> open(const btr::RealityContext&) const override { return nullptr; }
};

}  // namespace

BTR_REALITY(Remote, "remote")
