#pragma once
#include <exception>

namespace btr::cli {

/// A failure of which a process that was started has told the user on standard error: nothing is left to say.
class AlreadySaid : public std::exception {
 public:
  const char* what() const noexcept override { return "what was started has said why"; }
};

}  // namespace btr::cli
