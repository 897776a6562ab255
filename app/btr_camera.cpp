// btr camera: another program beside this one, as it needs OpenCV and a renderer.
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

std::optional<int> passOnCamera(int argc, char** argv) {
  int at = 1;
  while (at < argc && std::strcmp(argv[at], "--json") == 0) ++at;
  if (at >= argc || std::strcmp(argv[at], "camera") != 0) return {};
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::string program = (folder / "btr-camera").string();
  std::vector<char*> arguments{program.data()};
  for (int i = 1; i < argc; ++i)
    if (i != at) arguments.push_back(argv[i]);
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  std::fprintf(stderr, "btr: %s: cannot be started (%s); it is built and installed with the window\n", program.c_str(),
               std::strerror(errno));
  return badInput;
}

}  // namespace btr::cli
