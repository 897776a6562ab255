#pragma once
#include <string>
#include <vector>

#include "core/live/act.h"

namespace uchilsim::v1 {
class Act;
class PoseRequest;
class NumberParts;
}  // namespace uchilsim::v1

namespace btr::remote {

/// An act as a client says it. Bounds and names are judged by Session::apply(). Throws InputError where it says none,
/// or a vector has another length.
Act actOf(const uchilsim::v1::Act& message);

/// A body where somebody else has it: placed, and where it moves thrown.
std::vector<Act> actsOf(const uchilsim::v1::PoseRequest& message);

/// A declared number for a client.
void describe(const Parameter& parameter, uchilsim::v1::NumberParts& out);

}  // namespace btr::remote
