/// People measure the robot and enter the values: measurement sheet, `btr fitness enter`, a CSV file.
#include "core/plugin/plugin.h"

namespace {

class Person final : public btr::Reality {
  std::string meaning() const override { return "A person measures the real robot and enters the values"; }
  std::string who() const override { return "person"; }
  std::unique_ptr<btr::RealRobot> open(const btr::RealityContext&) const override { return nullptr; }
};

}  // namespace

BTR_REALITY(Person, "person")
