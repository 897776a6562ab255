#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/remote/frame.h"
#include "core/remote/refusal.h"

namespace btr::remote {

/// What the server passes on to its processes; the first byte of a call, a message of the schema follows.
enum class Method : char {
  open = 'o',
  describe = 'd',
  get = 'g',
  reset = 'r',
  step = 's',
  pose = 'p',
  play = 'y',
  type = 't',
  save = 'v',
  close = 'c',
  logFiles = 'l',
  picture = 'P',
  pictureMemory = 'Q',
  robot = 'B',
  describeExperiment = 'D',
  evaluate = 'E',
  runs = 'R',
  generations = 'G',
  individuals = 'I',
  start = 'S',
  run = 'O',
  stop = 'X',
  forgetStop = 'F',
  wanted = 'W',
  measured = 'M',
  work = 'w',
};

inline std::string callOf(Method method, const std::string& message) { return static_cast<char>(method) + message; }

/// Where one kind of calls is answered, in a process of its own.
class Desk {
 public:
  virtual ~Desk() = default;
  /// The bytes of the answer's message. Throws Refusal or InputError.
  virtual std::string answer(Method method, std::string_view message) = 0;
  /// How long it can wait for a call [s], negative: for ever; then goOn() is due.
  virtual double patience_s() const { return -1; }
  virtual void goOn() {}

  /// Called by a long answer between its pieces. serve() tells who waits that this is still at work, and throws Refusal
  /// where the answer is to be left.
  std::function<void()> betweenPieces = [] {};
};

/// The largest answer: one byte of a frame is its code.
inline constexpr std::size_t largestAnswer = largestFrame - 1;

/// One call, whatever its bytes: never throws.
Answer answerCall(Desk& desk, std::string_view call);

/// Answers calls at a socket until its other end hangs up. While an answer takes long an empty frame goes out each
/// `beat_s`, and it is left where `isToLeave` says so, if given: a call that was not begun then is not left.
void serve(Desk& desk, int socket, double beat_s = 1, const std::function<bool()>& isToLeave = {});

/// Throws Refusal where the bytes are no such message.
template <class Message>
Message messageOf(std::string_view bytes) {
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    throw Refusal(Code::invalid, "the bytes of a request are no message of uchilsim.v1");
  return message;
}

}  // namespace btr::remote
