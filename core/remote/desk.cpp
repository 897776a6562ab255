#include "core/remote/desk.h"

#include <new>

#include "core/remote/frame.h"
#include "core/spec/error.h"

namespace btr::remote {

Answer answerCall(Desk& desk, std::string_view call) {
  if (call.empty()) return {Code::invalid, "an empty call"};
  try {
    return {Code::ok, desk.answer(static_cast<Method>(call[0]), call.substr(1))};
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

void serve(Desk& desk, int socket) {
  std::string call;
  while (true) {
    const Got got = receiveFrame(socket, call, desk.patience_s());
    if (got == Got::hungUp) return;
    if (got == Got::frame) {
      const Answer answer = answerCall(desk, call);
      if (!sendFrame(socket, static_cast<char>(answer.code) + answer.bytes)) return;
    }
    desk.goOn();
  }
}

}  // namespace btr::remote
