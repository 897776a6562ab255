#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/cluster/coordinator.h"
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
  // A rank that has had nothing to do for a while looks less often whether there is something.
  constexpr int busy_ms = 2, idle_ms = 5;
  constexpr std::chrono::seconds soon(1);
  auto last = std::chrono::steady_clock::now();
  while (true) {
    const auto now = std::chrono::steady_clock::now();
    for (const Crew::Event& event : crew.wait(now - last < soon ? busy_ms : idle_ms)) {
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
      else
        crew.send(foreman, Parts(parts.begin() + 2, parts.end()));
    }
  }
}

}  // namespace btr
