#pragma once
#include <optional>

#include "core/store/database.h"

namespace btr {

/// A simulator version that L3 adapted to a measured value, and the version before it.
struct RestingSimulator {
  int number = 0, parent = 0, stage = 0;
};

/// The first version among the newest one and those that it comes from which was adapted to a value of this individual:
/// when such a value is made void, that version stays as it is, and only going back to its parent undoes what the value
/// did. Nothing if none was, or if the run went back already.
std::optional<RestingSimulator> simulatorRestingOn(const Database& database, Id run, Id individual);

}  // namespace btr
