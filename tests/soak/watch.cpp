#include "tests/soak/watch.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace btr::soak {
namespace {

namespace fs = std::filesystem;

int entries(const std::string& folder) {
  std::error_code error;
  return static_cast<int>(std::distance(fs::directory_iterator(folder, error), fs::directory_iterator()));
}

int childrenOf(pid_t parent) {
  int children = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc", error)) {
    std::ifstream stat(entry.path() / "stat");
    std::string line;
    if (!std::isdigit(static_cast<unsigned char>(entry.path().filename().string()[0])) || !std::getline(stat, line))
      continue;
    // "PID (name) state parent …"; a name may hold anything.
    int ofWhom = 0;
    char state = 0;
    if (std::sscanf(line.c_str() + line.rfind(')') + 1, " %c %d", &state, &ofWhom) == 2 && ofWhom == parent) ++children;
  }
  return children;
}

std::vector<Held> firstHalf(const std::vector<Held>& looks) {
  return {looks.begin(), looks.begin() + static_cast<std::ptrdiff_t>(looks.size() / 2)};
}
std::vector<Held> secondHalf(const std::vector<Held>& looks) {
  return {looks.begin() + static_cast<std::ptrdiff_t>(looks.size() / 2), looks.end()};
}

template <class Number>
Number most(const std::vector<Held>& looks, Number Held::*what) {
  Number largest = 0;
  for (const Held& held : looks) largest = std::max(largest, held.*what);
  return largest;
}

}  // namespace

Held lookAt(const std::string& folder) {
  Held held;
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  held.resident_mb = 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
  held.handles = entries("/proc/self/fd") - 1;  // less the one that lists them
  held.threads = entries("/proc/self/task");
  held.children = childrenOf(getpid());
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
    if (!entry.is_regular_file(error)) continue;
    const double mb = 1e-6 * static_cast<double>(entry.file_size(error));
    ++held.files;
    held.files_mb += mb;
    if (entry.path().string().ends_with("-wal")) held.largest_mb = std::max(held.largest_mb, mb);
  }
  return held;
}

double memoryGrowth_mb_h(const std::vector<Held>& looks) {
  const std::vector<Held> late = secondHalf(looks);
  double t = 0, m = 0, tt = 0, tm = 0;
  for (const Held& held : late) {
    t += held.after_s / 3600 / static_cast<double>(late.size());
    m += held.resident_mb / static_cast<double>(late.size());
  }
  for (const Held& held : late) {
    tt += (held.after_s / 3600 - t) * (held.after_s / 3600 - t);
    tm += (held.after_s / 3600 - t) * (held.resident_mb - m);
  }
  return tt > 0 ? tm / tt : 0;
}

std::string table(const std::vector<Held>& looks, std::size_t rows) {
  std::string text =
      "   after   memory MB  handles  children  threads  files  files MB  log MB  individuals  measured  replays  "
      "analyses\n";
  const std::size_t every = std::max<std::size_t>(1, looks.size() / rows);
  for (std::size_t k = 0; k < looks.size(); ++k) {
    if (k % every != 0 && k + 1 != looks.size()) continue;
    const Held& h = looks[k];
    char line[200];
    std::snprintf(line, sizeof line, "%6.1f min %9.1f %8d %9d %8d %6d %9.2f %7.2f %12ld %9ld %8ld %9ld\n",
                  h.after_s / 60, h.resident_mb, h.handles, h.children, h.threads, h.files, h.files_mb, h.largest_mb,
                  h.individuals, h.measured, h.replays, h.analyses);
    text += line;
  }
  return text;
}

std::vector<std::string> complaints(const std::vector<Held>& looks, std::size_t period, double allowed_mb) {
  if (looks.size() < 4) return {"too few looks to say anything: let it run longer"};
  std::vector<std::string> found;
  const std::vector<Held> early = firstHalf(looks), late = secondHalf(looks);
  const auto grows = [&](int Held::*what, const char* name) {
    if (most(late, what) > most(early, what))
      found.push_back(std::string(name) + " grew from " + std::to_string(most(early, what)) + " to " +
                      std::to_string(most(late, what)));
  };
  grows(&Held::handles, "open handles");
  grows(&Held::children, "child processes");
  grows(&Held::threads, "threads");
  char text[128];
  if (looks.size() >= 4 * period) {
    grows(&Held::files, "files");
    const double before_mb = most(early, &Held::files_mb), after_mb = most(late, &Held::files_mb);
    std::snprintf(text, sizeof text, "files grew from %.2f to %.2f MB", before_mb, after_mb);
    if (after_mb > 1.2 * before_mb) found.push_back(text);
  }
  const double growth_mb = memoryGrowth_mb_h(looks) * (late.back().after_s - late.front().after_s) / 3600;
  std::snprintf(text, sizeof text, "memory grew by %.1f MB in the second half; at most %.1f is allowed", growth_mb,
                allowed_mb);
  if (growth_mb > allowed_mb) found.push_back(text);
  return found;
}

}  // namespace btr::soak
