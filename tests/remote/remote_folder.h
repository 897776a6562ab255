#pragma once
// A folder for a server's files, and what tests play in it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/remote/desk.h"
#include "core/remote/games_folder.h"
#include "tests/temporary_folder.h"

namespace btr::test {

// Tokens of each role.
inline constexpr const char* watcher = "watch-0123456789abcdef0123";
inline constexpr const char* driver = "drive-0123456789abcdef0123";
inline constexpr const char* administrator = "admin-0123456789abcdef0123";

/// DIR/server with a robot, a scene, an experiment and two games; DIR is what lies outside of it.
class RemoteFolder {
 public:
  RemoteFolder() {
    namespace fs = std::filesystem;
    const fs::path resources = SOURCE_DIR "/resources";
    for (const char* file : {"robots/ers7.wrl", "scenes/kick.json", "experiments/kick-short.json"}) {
      fs::create_directories((server() / file).parent_path());
      fs::copy_file(resources / file, server() / file);
    }
    write("ball.json", ballGame());
    write("dog.json", dogGame());
  }

  const std::filesystem::path& outside() const { return temporary_.path(); }
  std::filesystem::path server() const { return outside() / "server"; }
  std::string file(const std::string& name) const { return temporary_.file(name); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(server() / name, std::ios::binary) << text;
  }
  /// Names of all files outside of the server's folder and inside, sorted: what a refused call must not change.
  std::string listing() const {
    std::string names;
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(outside()))
      all.push_back(entry.path().string());
    std::ranges::sort(all);
    for (const std::string& name : all) names += name + "\n";
    return names;
  }

  static std::string ballGame() {
    return R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "step_s": 0.008,
      "floor": {"friction": 1}, "balls": [{"name": "ball", "position_m": [0, 0, 0.2]}]}})";
  }
  static std::string dogGame() {
    return R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "step_s": 0.008,
      "floor": {"friction": 1}, "robots": [{"name": "red1", "model": "robots/ers7.wrl"}],
      "balls": [{"name": "ball", "position_m": [0.5, 0, 0.0425]}]}})";
  }

 private:
  TemporaryFolder temporary_;
};

inline const PluginHost& plugins() {
  static const PluginHost host(PLUGIN_DIR);
  return host;
}

/// The answer's message; fails the test where the call was refused.
template <class Reply, class Request>
Reply answered(remote::Desk& desk, remote::Method method, const Request& request, const std::string& before = "") {
  const remote::Answer answer = answerCall(desk, callOf(method, before + request.SerializeAsString()));
  EXPECT_EQ(remote::Code::ok, answer.code) << answer.bytes;
  Reply reply;
  const bool isRead = answer.code != remote::Code::ok || reply.ParseFromString(answer.bytes);
  EXPECT_TRUE(isRead);
  return reply;
}

/// The sentence with which a call is refused, or "accepted".
template <class Request>
std::string refused(remote::Desk& desk, remote::Method method, const Request& request, const std::string& before = "") {
  const remote::Answer answer = answerCall(desk, callOf(method, before + request.SerializeAsString()));
  return answer.code == remote::Code::ok ? "accepted" : answer.bytes;
}

inline constexpr const char* worldName = "0123456789abcdef";

}  // namespace btr::test
