// Games, scenes and acts on any bytes. The first byte chooses: the text of a game, that of a scene, lines of acts as
// text, or acts whose numbers are the bytes. What can be opened also runs. Anything but a world that goes on, one that
// stopped with a reason, or an InputError is a finding; so is a number in a trace that is none.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>

#include "core/live/session.h"
#include "core/live/undo.h"
#include "core/spec/error.h"

namespace {

using namespace btr;

const PluginHost& noPlugins() {
  static const PluginHost host([] {
    const auto folder = std::filesystem::temp_directory_path() / "fuzz_game_no_plugins";
    std::filesystem::create_directories(folder);
    return folder.string();
  }());
  return host;
}

/// A dog, a ball, a box and a referee.
Game begun() {
  static const Game game = gameFromJson(R"({"format": "uchilsim-game-1",
    "scene": {"format": "uchilsim-scene-1", "step_s": 0.008, "floor": {}, "robots_collide": true,
      "field": {"length_m": 4.2, "width_m": 2.7, "goals": {"width_m": 0.6, "depth_m": 0.3, "height_m": 0.3}},
      "robots": [{"name": "red1", "model": "ers7.wrl"}], "balls": [{"name": "ball", "position_m": [0.5, 0, 0.1]}],
      "obstacles": [{"name": "box", "mass_kg": 0.2, "position_m": [-0.5, 0, 0.05]}]},
    "robots": {"red1": {"team": "red", "senses": "ers7"}}, "referee": {}})",
                                        "fuzz.json", SOURCE_DIR "/resources/robots");
  return game;
}

void check(const Session& session) {
  std::vector<double> row;
  session.sample(row);
  for (const double number : row)
    if (!std::isfinite(number)) std::abort();
}

/// Numbers and choices from bytes; zeros where they end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool atEnd() const { return at_ >= size_; }
  std::uint8_t byte() { return atEnd() ? 0 : data_[at_++]; }
  double number() {
    const std::uint8_t kind = byte();
    if (kind < 250) return (kind - 125) * 0.008;
    double value = 0;
    if (at_ + sizeof value <= size_) std::memcpy(&value, data_ + at_, sizeof value);
    at_ += sizeof value;
    return value;  // anything, infinity and what is no number among it
  }
  std::array<double, 3> point() { return {number(), number(), number()}; }
  std::string word(std::initializer_list<const char*> words) { return words.begin()[byte() % words.size()]; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

Act actFrom(Bytes& bytes) {
  const std::string object = bytes.word({"red1", "ball", "box", "new", "nobody"});
  const std::string joint = bytes.word({"LF_J1", "HEAD_PAN", "NOSE"});
  switch (bytes.byte() % 12) {
    case 0:
      return PlaceAct{object, bytes.point(), {1, 0, 0, 0}};
    case 1:
      return PlaceAct{object, bytes.point(), {bytes.number(), bytes.number(), 0, 1}, {{joint, bytes.number()}}};
    case 2:
      return ThrowAct{object, bytes.point(), bytes.point()};
    case 3:
      return PullAct{object,        bytes.word({"", "HEAD", "NOSE"}), bytes.point(), bytes.point(), bytes.number(),
                     bytes.number()};
    case 4:
      return LetGoAct{object};
    case 5: {
      BallSpec ball;
      ball.name = object;
      ball.position_m = bytes.point();
      return AddAct{ball};
    }
    case 6: {
      ObstacleSpec obstacle;
      obstacle.name = object;
      obstacle.shape = bytes.word({"box", "cylinder", "sphere", "ramp"});
      obstacle.mass_kg = bytes.byte() % 2;
      obstacle.position_m = bytes.point();
      return AddAct{obstacle};
    }
    case 7:
      return RemoveAct{object};
    case 8:
      return HoldAct{object, joint, bytes.number()};
    case 9:
      return NumberAct{"", "friction", bytes.number()};
    case 10:
      return KickOffAct{};
    default:
      return CheckpointAct{};
  }
}

void playActs(Bytes bytes) {
  Session session(begun(), noPlugins());
  UndoStack stack;
  for (int i = 0; i < 20 && !bytes.atEnd() && session.fault().empty(); ++i) {
    try {
      if (bytes.byte() % 8 == 0)
        stack.undo(session);
      else
        stack.apply(session, actFrom(bytes));
    } catch (const InputError&) {
    }
    for (int step = bytes.byte() % 4; step > 0; --step) session.step();
    check(session);
  }
  session.save();
}

void playLines(const std::string& text) {
  Session session(begun(), noPlugins());
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < 20 && std::getline(lines, line) && session.fault().empty(); ++i) {
    try {
      session.apply(actFromJson(line, "act"));
    } catch (const InputError&) {
    }
    session.step();
    check(session);
  }
}

void playGame(Game game) {
  constexpr std::size_t few = 8;
  if (game.scene.robots.size() + game.scene.balls.size() + game.scene.obstacles.size() > few) return;
  Session session(std::move(game), noPlugins());
  for (int i = 0; i < 5; ++i) session.step();
  check(session);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    switch (data[0] % 4) {
      case 0:
        playGame(gameFromJson(text, "fuzz.json", SOURCE_DIR "/resources/robots"));
        break;
      case 1: {
        Game game;
        game.scene = sceneFromJson(text, "fuzz.json", SOURCE_DIR "/resources/robots");
        playGame(std::move(game));
        break;
      }
      case 2:
        playLines(text);
        break;
      default:
        playActs(Bytes(data + 1, size - 1));
    }
  } catch (const InputError&) {
  }
  return 0;
}
