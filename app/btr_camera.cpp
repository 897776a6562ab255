// btr camera and btr serve: other programs beside this one, as they need OpenCV and a renderer, or gRPC.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "app/btr_commands.h"

namespace btr::cli {

void addCameraCommand(CLI::App& app) {
  app.add_subcommand("camera", "the robot's camera: btr-camera, beside this program")->prefix_command();
}

void addServeCommand(CLI::App& app) {
  app.add_subcommand("serve", "the open interface for other people's programs: btr-serve, beside this program")
      ->prefix_command();
}

std::optional<int> passOn(int argc, char** argv) {
  int at = 1;
  while (at < argc && std::strcmp(argv[at], "--json") == 0) ++at;
  if (at >= argc) return {};
  const std::string command = argv[at];
  if (command != "camera" && command != "serve") return {};
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::string program = (folder / ("btr-" + command)).string();
  std::vector<char*> arguments{program.data()};
  for (int i = 1; i < argc; ++i)
    if (i != at) arguments.push_back(argv[i]);
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  std::fprintf(stderr, "btr: %s: cannot be started (%s)%s\n", program.c_str(), std::strerror(errno),
               command == "camera" ? "; it is built and installed with the window" : "");
  return badInput;
}

}  // namespace btr::cli
