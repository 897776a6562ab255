#pragma once

namespace btr {

/// Thrown where somebody who was asked whether to go on said no.
struct Cancelled {};

}  // namespace btr
