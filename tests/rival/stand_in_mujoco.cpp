// stand_in_mujoco stand-in --db DATABASE --run RUN: another engine plays the real robot of a run whose experiment says
// "played_by": "program". It speaks the lines of `btr stand-in`; every answer's note names it. What is concealed is
// drawn as ever; only joint effects act.
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "core/run/reality/stand_in.h"
#include "core/spec/error.h"
#include "core/store/database.h"
#include "tests/rival/rival_trial.h"

int main(int count, char** words) {
  using namespace btr;
  const std::vector<std::string> given(words + 1, words + count);
  if (given.size() != 5 || given[0] != "stand-in" || given[1] != "--db" || given[3] != "--run") {
    std::fprintf(stderr, "usage: stand_in_mujoco stand-in --db DATABASE --run RUN\n");
    return 2;
  }
  try {
    const PluginHost host(PLUGIN_DIR);
    const RunRecord record = Database::open(given[2], Database::Mode::readOnly).run(std::stoll(given[4]));
    serveStandIn(asReality(prepareFromRun(record, host), record.seed), host, std::cin, std::cout, rival::mujocoWorld());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stand_in_mujoco: %s\n", error.what());
    return 1;
  }
}
