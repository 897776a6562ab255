#pragma once
#include <sys/types.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace btr::test {

/// The processes that descend from this one, by their parents; ascending.
inline std::vector<pid_t> descendants() {
  std::vector<std::pair<pid_t, pid_t>> parents;  // process, its parent
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::string text;
    std::ifstream file(entry.path() / "stat");
    std::getline(file, text);
    if (text.empty()) continue;
    std::istringstream rest(text.substr(text.rfind(')') + 1));
    std::string state;
    pid_t parent = 0;
    rest >> state >> parent;
    parents.emplace_back(std::stoi(name), parent);
  }
  std::set<pid_t> ours{getpid()};
  for (std::size_t before = 0; before != ours.size();) {
    before = ours.size();
    for (const auto& [process, parent] : parents)
      if (ours.contains(parent)) ours.insert(process);
  }
  ours.erase(getpid());
  return {ours.begin(), ours.end()};
}

}  // namespace btr::test
