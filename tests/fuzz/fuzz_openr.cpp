// What goes between a robot and its program, and what the builder of programs reads, on any bytes. The first byte
// chooses: a frame, orders, a stub.cfg, lists of a stick, or a compiler's errors. Anything but a value or an InputError
// is a finding; so is a message that does not come back as the same bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/openr/builder/robot_longs.h"
#include "core/openr/builder/source_cure.h"
#include "core/openr/builder/stub_generator.h"
#include "core/openr/robot_link.h"
#include "core/openr/stick_config.h"
#include "core/spec/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace btr::openr;
  if (size == 0) return 0;
  const std::uint8_t* bytes = data + 1;
  const std::size_t count = size - 1;
  const std::string text(reinterpret_cast<const char*>(bytes), count);
  const std::vector<std::uint8_t> given(bytes, bytes + count);
  try {
    switch (data[0] % 5) {
      case 0:
        if (bytesOf(sensorFrameFrom(bytes, count)) != given) std::abort();
        break;
      case 1:
        if (bytesOf(orderFrameFrom(bytes, count)) != given) std::abort();
        break;
      case 2:
        stubFiles(stubConfigFrom(text, "stub.cfg"));
        break;
      case 3:
        configLines(text, "ERS-7");
        break;
      case 4: {
        const std::size_t half = count / 2;
        withoutRepeatedNames(text.substr(0, half), text.substr(half));
        if (withRobotLongs(text, "").size() != text.size()) std::abort();
        break;
      }
    }
  } catch (const btr::InputError&) {
  }
  return 0;
}
