// Calls to a world of the open interface on any bytes: the first byte says how the rest is cut into calls. Anything but
// an answer is a finding: so is a state whose row holds what is no number, and a file outside of the server's folder.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/remote/world_desk.h"
#include "uchilsim.pb.h"

namespace {

using namespace btr;
using namespace btr::remote;
namespace fs = std::filesystem;
namespace v1 = uchilsim::v1;

/// DIR/server is what clients may name, with a robot and two games; nothing else may appear in DIR.
struct Place {
  fs::path outside = fs::temp_directory_path() / ("fuzz_remote_" + std::to_string(getpid()));
  Place() {
    fs::create_directories(outside / "server" / "robots");
    fs::create_directories(outside / "plugins");
    fs::copy_file(SOURCE_DIR "/resources/robots/ers7.wrl", outside / "server" / "robots" / "ers7.wrl",
                  fs::copy_options::overwrite_existing);
  }
  ~Place() { fs::remove_all(outside); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(outside), fs::directory_iterator()));
  }
};

/// A ball and a box; rarely a dog, which takes a hundred times as long to read.
const char* const things = R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "step_s": 0.008,
  "floor": {}, "balls": [{"name": "ball", "position_m": [0.5, 0, 0.1]}],
  "obstacles": [{"name": "box", "mass_kg": 0.2, "position_m": [-0.5, 0, 0.05]}]}})";
const char* const dog = R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "step_s": 0.008,
  "floor": {}, "robots": [{"name": "red1", "model": "robots/ers7.wrl"}],
  "balls": [{"name": "ball", "position_m": [0.5, 0, 0.1]}]}})";

void answer(Desk& desk, std::string call, const Place& place) {
  // Long steps only take long.
  if (call[0] == static_cast<char>(Method::step)) {
    v1::StepRequest step;
    if (step.ParseFromString(call.substr(1)) && step.periods() > 20) {
      step.set_periods(step.periods() % 20);
      call = callOf(Method::step, step.SerializeAsString());
    }
  }
  const Answer got = answerCall(desk, call);
  if (got.code == Code::internal) std::abort();
  if (got.code != Code::ok) return;
  if (call[0] == static_cast<char>(Method::step) || call[0] == static_cast<char>(Method::get)) {
    v1::State state;
    if (!state.ParseFromString(got.bytes)) std::abort();
    for (const double number : state.row())
      if (!std::isfinite(number)) std::abort();
  }
  if (place.entries() != 2) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  static const PluginHost host((place.outside / "plugins").string());
  static const GamesFolder folder((place.outside / "server").string(), true);
  google::protobuf::SetLogHandler(nullptr);
  if (size < 2) return 0;
  const std::string all(reinterpret_cast<const char*>(data) + 1, size - 1);
  WorldDesk desk(host, folder);
  const std::string name = "0123456789abcdef";
  if (data[0] % 4 == 0) {
    // A game of the bytes.
    v1::OpenRequest open;
    open.set_game_json(all);
    open.set_unlogged(true);
    answer(desk, callOf(Method::open, name + open.SerializeAsString()), place);
    return 0;
  }
  v1::OpenRequest open;
  open.set_game_json(data[0] % 64 == 7 ? dog : things);
  open.set_unlogged(data[0] % 4 == 1);
  answer(desk, callOf(Method::open, name + open.SerializeAsString()), place);
  // A call's length comes before it.
  for (std::size_t at = 0, calls = 0; at + 1 < all.size() && calls < 20; ++calls) {
    const std::size_t length = 1 + static_cast<std::uint8_t>(all[at]);
    answer(desk, all.substr(at + 1, length), place);
    at += 1 + length;
  }
  return 0;
}
