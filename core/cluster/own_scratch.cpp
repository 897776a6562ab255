#include "core/cluster/own_scratch.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <filesystem>

namespace btr {
namespace {

namespace fs = std::filesystem;

std::string beginningOf(const std::string& what) { return "uchilsim-" + what + "-"; }

}  // namespace

std::string ownScratchName(const std::string& what) { return beginningOf(what) + std::to_string(getpid()); }

void removeAbandonedScratch(const std::string& what) {
  std::error_code error;  // what cannot be removed now is tried again by the next one
  const std::string beginning = beginningOf(what);
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(beginning)) continue;
    pid_t maker = 0;
    std::from_chars(name.data() + beginning.size(), name.data() + name.size(), maker);
    if (maker > 0 && kill(maker, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path(), error);
  }
}

}  // namespace btr
