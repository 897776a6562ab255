#include "app/live/btr_camera_eye.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/live/btr_camera_process.h"
#include "app/live/btr_live_lines.h"
#include "core/spec/error.h"

namespace btr::cli {
namespace {

/// `btr-camera eye`: told each row, it answers with a frame or with none.
class ProcessEye final : public CameraEye {
 public:
  explicit ProcessEye(const std::string& robot) : process_({"eye", "--rgb", "--robot", robot}, true) {}

  void ask(const Session& session) override {
    if (std::vector<std::string> channels = session.channels(); channels != channels_) {
      channels_ = std::move(channels);
      tell(gameLine(session));
    }
    tell(rowLine(session, true, 0));
    asked_ = true;
  }

  std::optional<CameraPicture> look(const Session& session) override {
    if (!asked_) ask(session);
    asked_ = false;
    if (gone_) gone();
    // Width and height, each 4 bytes, the lowest first; whether there are classes; then the pixels.
    std::array<std::uint8_t, 9> head{};
    hear(head.data(), head.size());
    const auto number = [&](std::size_t at) {
      return head[at] | head[at + 1] << 8 | head[at + 2] << 16 | head[at + 3] << 24;
    };
    CameraPicture picture{number(0), number(4), {}};
    if (picture.width == 0) return std::nullopt;
    picture.rgb.resize(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    hear(picture.rgb.data(), picture.rgb.size());
    if (head.back() == 0) return picture;
    picture.classes.resize(picture.rgb.size() / 3);
    hear(picture.classes.data(), picture.classes.size());
    return picture;
  }

 private:
  void tell(const nlohmann::json& line) { gone_ = gone_ || !process_.send(line.dump()); }
  void hear(std::uint8_t* bytes, std::size_t count) {
    if (!process_.read(bytes, count)) gone();
  }
  [[noreturn]] static void gone() {
    throw InputError(
        "the camera's process has ended; the server's standard error says why (no OpenGL, or a robot whose "
        "model has no camera)");
  }

  CameraProcess process_;
  std::vector<std::string> channels_;
  bool asked_ = false;  ///< its answer has not been read
  bool gone_ = false;
};

}  // namespace

CameraMaker cameraMaker() {
  namespace fs = std::filesystem;
  if (!fs::exists(fs::read_symlink("/proc/self/exe").parent_path() / "btr-camera")) return {};
  return [](const std::string& robot) { return std::make_unique<ProcessEye>(robot); };
}

}  // namespace btr::cli
