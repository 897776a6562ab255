#pragma once
#include "core/plugin/plugin.h"

/// An effect that does nothing, for modules that test the host.
class EmptyEffect final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override { return {{"size", "", "nothing", 0, 1, 0, 0.0}}; }
  Place place() const override { return Place::joint; }
};
