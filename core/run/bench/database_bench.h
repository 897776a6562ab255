#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"

namespace btr {

/// What a page of the window or a command asks of a database, and how long it takes.
struct DatabaseTiming {
  std::string what;
  double seconds = 0;  ///< wall time: best of a few, a file that the system has read before
  long rows = 0;       ///< of what was read
};

struct DatabaseBench {
  std::string path;
  long runs = 0, individuals = 0;
  double bytes = 0;            ///< of the file
  double individualBytes = 0;  ///< of that rows of individuals with their indices
  double traceBytes = 0;       ///< of that traces of measured trials
  double peak_mb = 0;          ///< largest resident memory of this process until now [1e6 bytes]
  std::vector<DatabaseTiming> timings;
};

/// Times the questions of each page. Reads only. `goesOn` is asked between them.
DatabaseBench benchDatabase(const std::string& path, const PluginHost& host, int repeats = 3,
                            const std::function<bool()>& goesOn = nullptr);

/// For people.
std::string databaseBenchTable(const DatabaseBench& bench);

}  // namespace btr
