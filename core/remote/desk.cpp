#include "core/remote/desk.h"

#include <algorithm>
#include <new>

#include "core/remote/clock.h"
#include "core/spec/error.h"

namespace btr::remote {
namespace {

// One caller after the other uses the socket. What has to go on at a time of its own waits a moment for those that
// stood behind the one that was answered: each would wait for a piece of its work otherwise, and see every second
// picture.
constexpr double nextCall_s = 0.0005;
constexpr int callsInARow = 16;

}  // namespace

Answer answerCall(Desk& desk, std::string_view call) {
  if (call.empty()) return {Code::invalid, "an empty call"};
  try {
    Answer answer{Code::ok, desk.answer(static_cast<Method>(call[0]), call.substr(1))};
    if (answer.bytes.size() <= largestAnswer) return answer;
    return {Code::tooMuch, "the answer has " + std::to_string((answer.bytes.size() >> 20) + 1) + " MB; at most " +
                               std::to_string(largestFrame >> 20) +
                               " MB is allowed: ask for less at a time (fewer vectors, generations or channels)"};
  } catch (const Refusal& refusal) {
    return {refusal.code, refusal.what()};
  } catch (const InputError& error) {
    return {Code::invalid, error.what()};
  } catch (const std::bad_alloc&) {
    return {Code::tooMuch, "the server's memory does not suffice for this call"};
  } catch (const std::exception& error) {
    return {Code::internal, error.what()};
  }
}

void serve(Desk& desk, int socket, double beat_s, const std::function<bool()>& isToLeave) {
  std::string call;
  double told_s = 0;
  desk.betweenPieces = [&] {
    if (isToLeave && isToLeave()) throw Refusal(Code::cancelled, "the server ends");
    if (now_s() - told_s < beat_s) return;
    sendFrame(socket, "");
    told_s = now_s();
  };
  int answered = 0;  // since it went on
  while (true) {
    const double patience_s = desk.patience_s();
    const bool waits = patience_s >= 0 && answered > 0;
    const Got got = receiveFrame(socket, call, waits ? std::max(patience_s, nextCall_s) : patience_s);
    if (got == Got::hungUp) return;
    if (got == Got::frame) {
      told_s = now_s();
      const Answer answer = answerCall(desk, call);
      if (sendFrame(socket, static_cast<char>(answer.code) + answer.bytes) != Sent::whole) return;
      if (++answered < callsInARow && desk.patience_s() >= 0) continue;
    }
    desk.goOn();
    answered = 0;
  }
}

}  // namespace btr::remote
