#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "core/cluster/ranks.h"
#include "core/spec/error.h"

namespace btr {
namespace {

/// Says to rank 0 what a foreman says.
void passOn(RankLink& link, const Crew::Event& event) {
  Parts whole{std::to_string(event.foreman)};
  whole.insert(whole.end(), event.parts.begin(), event.parts.end());
  link.send(0, pack(whole));
}

}  // namespace

std::string hostName() {
  char name[256] = "";
  if (gethostname(name, sizeof name - 1) != 0) return "?";
  return name;
}

void serveRank(RankLink& link, const CoordinatorOptions& options) {
  Crew crew(options.foremen, options.command);
  link.send(0, pack({"crew", hostName(), std::to_string(crew.size()), options.words}));
  auto last = std::chrono::steady_clock::now();
  std::vector<int> open(static_cast<std::size_t>(crew.size()), 0);  ///< by foreman: what it was told to do
  while (true) {
    const auto now = std::chrono::steady_clock::now();
    const bool isIdle = std::ranges::all_of(open, [](int pieces) { return pieces <= 0; });
    for (const Crew::Event& event : crew.wait(momentToWait(now - last, isIdle))) {
      int& pieces = open[static_cast<std::size_t>(event.foreman)];
      const std::string& kind = event.parts.front();
      pieces = kind == "done" ? pieces - 1 : kind == "lost" || kind == "gone" ? 0 : pieces;
      passOn(link, event);
      last = now;
    }
    int from = 0;
    std::string bytes;
    while (link.receive(from, bytes)) {
      last = now;
      const Parts parts = unpack(bytes);
      if (parts.front() == "quit") return;
      const int foreman = std::stoi(parts[1]);
      if (parts.front() == "restart")
        crew.restart(foreman);
      else {
        const bool isWork = parts[2] == "piece" || parts[2] == "jobs";
        if (isWork) ++open[static_cast<std::size_t>(foreman)];
        crew.send(foreman, Parts(parts.begin() + 2, parts.end()));
      }
    }
  }
}

}  // namespace btr
