#pragma once
#include <stdexcept>
#include <string>

namespace btr::remote {

/// How a call ended; the numbers are gRPC's.
enum class Code : int {
  ok = 0,
  cancelled = 1,
  invalid = 3,
  tooLate = 4,
  notFound = 5,
  notAllowed = 7,
  tooMuch = 8,
  notNow = 9,
  notThere = 12,
  internal = 13,
  unavailable = 14,
  nobody = 16,
};

/// A call that is refused, with one sentence for people.
class Refusal : public std::runtime_error {
 public:
  Refusal(Code how, const std::string& sentence) : std::runtime_error(sentence), code(how) {}
  Code code;
};

/// What a call was answered: a message's bytes, or a sentence.
struct Answer {
  Code code = Code::ok;
  std::string bytes;
  bool begun = true;  ///< false: nothing was done, the same call may be tried again elsewhere
};

}  // namespace btr::remote
