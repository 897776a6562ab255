#include "core/openr/runtime/robot/primitives.h"

namespace btr::openr {
namespace {

constexpr OPrimitiveID first = 0x10000;

}  // namespace

Primitives::Primitives(const RobotDesign& design) {
  const auto add = [this](Of kind, const std::vector<Primitive>& list) {
    for (std::size_t i = 0; i < list.size(); ++i) all_.push_back({kind, i, list[i]});
  };
  add(Of::joint, design.joints);
  add(Of::sensor, design.sensors);
  add(Of::lamp, design.lamps);
  add(Of::other, design.others);
}

OPrimitiveID Primitives::at(const std::string& locator) const {
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].primitive.locator == locator) return first + static_cast<OPrimitiveID>(i);
  return oprimitiveID_UNDEF;
}

const Primitives::Place* Primitives::find(OPrimitiveID id) const {
  return id < first || id - first >= all_.size() ? nullptr : &all_[id - first];
}

OPrimitiveID Primitives::idOf(Of kind, std::size_t place) const {
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].kind == kind && all_[i].place == place) return first + static_cast<OPrimitiveID>(i);
  return oprimitiveID_UNDEF;
}

OPrimitiveID Primitives::idOf(Primitive::Kind kind) const {
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].primitive.kind == kind) return first + static_cast<OPrimitiveID>(i);
  return oprimitiveID_UNDEF;
}

}  // namespace btr::openr
