#pragma once
#include <stdexcept>
#include <string>

namespace btr {

/// A condition that the caller has to keep, checked in every build: what would follow from its breach is no result.
/// Throws std::logic_error with `promise`, what had to hold.
inline void require(bool holds, const char* promise) {
  if (!holds) throw std::logic_error(std::string("fault of the program: ") + promise);
}

}  // namespace btr
