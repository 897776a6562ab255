#pragma once
#include <string>

#include "core/spec/error.h"

namespace btr::test {

/// The message of the InputError with which a call is refused, or "accepted". Any other exception fails the test.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace btr::test
