// The tests are their own foremen: those must have the build of who hands out the work.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/cluster/foreman.h"
#include "core/spec/system/process.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "pieces") {
    btr::beginProgram();
    const btr::PluginHost host(PLUGIN_DIR);
    const bool hasWorkers = argc > 3 && std::string(argv[2]) == "--workers";
    btr::servePieces(host, 120, hasWorkers ? std::atoi(argv[3]) : 1);
    return 0;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
