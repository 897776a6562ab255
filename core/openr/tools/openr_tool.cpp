// What the tools of the OPEN-R folder cannot do in a shell.
//   openr_tool stub FILE FOLDER     makes the stub that a stub.cfg asks for
//   openr_tool object FILE          says the line of an .ocf
//   openr_tool cure FILE.ii ERRORS  writes what the compiler's errors name as it wants it; 3 if there is nothing to do
//   openr_tool longs FILE.ii KIT    makes a `long` 32 bits wide but in headers of the system and KIT; 3: there is none
//   openr_tool headers ERRORS       says which headers are missing by the compiler's errors
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "core/openr/builder/object_settings.h"
#include "core/openr/builder/robot_longs.h"
#include "core/openr/builder/source_cure.h"
#include "core/openr/builder/stub_generator.h"
#include "core/openr/file_text.h"
#include "core/spec/error.h"

namespace {

constexpr int nothingToDo = 3;

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw btr::InputError(path + " cannot be read");
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "stub" && argc == 4) {
      for (const auto& [name, text] : btr::openr::stubFiles(btr::openr::stubConfigFrom(content(argv[2]), argv[2])))
        btr::openr::writeContent(std::string(argv[3]) + "/" + name, text);
      return 0;
    }
    if (what == "object" && argc == 3) {
      std::printf("%s\n", btr::openr::objectLineOf(content(argv[2]), argv[2]).c_str());
      return 0;
    }
    if (what == "cure" && argc == 4) {
      const std::string source = content(argv[2]), cured = btr::openr::curedSource(source, content(argv[3]));
      if (cured == source) return nothingToDo;
      btr::openr::writeContent(argv[2], cured);
      return 0;
    }
    if (what == "longs" && argc == 4) {
      const std::string source = content(argv[2]), narrow = btr::openr::withRobotLongs(source, argv[3]);
      if (narrow == source) return nothingToDo;
      btr::openr::writeContent(argv[2], narrow);
      return 0;
    }
    if (what == "headers" && argc == 3) {
      for (const std::string& header : btr::openr::missingHeaders(content(argv[2])))
        std::printf("%s\n", header.c_str());
      return 0;
    }
  } catch (const btr::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr,
               "openr_tool stub FILE FOLDER | openr_tool object FILE | openr_tool cure FILE.ii ERRORS | "
               "openr_tool longs FILE.ii KIT | openr_tool headers ERRORS\n");
  return 2;
}
