// What the tools of the OPEN-R folder cannot do in a shell.
//   openr_tool stub FILE FOLDER     makes the stub that a stub.cfg asks for
//   openr_tool cure FILE.ii ERRORS  drops parameter names that the compiler's errors say stand twice
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "core/openr/source_cure.h"
#include "core/openr/stub_generator.h"
#include "core/spec/error.h"

namespace {

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw btr::InputError(path + " cannot be read");
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void write(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw btr::InputError(path + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "stub" && argc == 4) {
      for (const auto& [name, text] : btr::openr::stubFiles(btr::openr::stubConfigFrom(content(argv[2]), argv[2])))
        write(std::string(argv[3]) + "/" + name, text);
      return 0;
    }
    if (what == "cure" && argc == 4) {
      write(argv[2], btr::openr::withoutRepeatedNames(content(argv[2]), content(argv[3])));
      return 0;
    }
  } catch (const btr::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "openr_tool stub FILE FOLDER | openr_tool cure FILE.ii ERRORS\n");
  return 2;
}
