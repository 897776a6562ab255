// A database of a million individuals: `bench_database make FILE [RUNS] [GENERATIONS]` writes it, `bench_database
// measure FILE` times it.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/run/bench/database_bench.h"
#include "core/run/bench/large_database.h"
#include "core/spec/error.h"

int main(int count, char** arguments) {
  const std::string what = count > 2 ? arguments[1] : "";
  if (what != "make" && what != "measure") {
    std::fprintf(stderr, "bench_database make FILE [RUNS] [GENERATIONS] | bench_database measure FILE\n");
    return 2;
  }
  try {
    const btr::PluginHost host(PLUGIN_DIR);
    if (what == "measure") {
      std::fputs(databaseBenchTable(btr::benchDatabase(arguments[2], host)).c_str(), stdout);
      return 0;
    }
    btr::LargeDatabase size;
    if (count > 3) size.runs = std::atoi(arguments[3]);
    if (count > 4) size.generations = std::atoi(arguments[4]);
    const auto begin = std::chrono::steady_clock::now();
    btr::makeLargeDatabase(arguments[2], host, SOURCE_DIR "/resources/experiments/kick-short.json", size);
    std::printf("%d runs, %ld individuals in %.0f s\n", size.runs, size.individuals(),
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return 0;
  } catch (const btr::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
