#include "core/openr/runtime/process/confine.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace btr::openr {
namespace {

// Of later kernels' headers than Debian 12 has to have.
constexpr std::uint64_t mayRefer = 1ull << 13, mayTruncate = 1ull << 14;

std::uint64_t changes(long version) {
  std::uint64_t all = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                      LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                      LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
                      LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 2) all |= mayRefer;
  if (version >= 3) all |= mayTruncate;
  return all;
}

}  // namespace

bool confine(const std::string& folder) {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  const std::uint64_t allowed = changes(version);
  landlock_ruleset_attr rules{};
  rules.handled_access_fs = allowed | LANDLOCK_ACCESS_FS_EXECUTE;
  const int set = static_cast<int>(syscall(SYS_landlock_create_ruleset, &rules, sizeof(rules.handled_access_fs), 0));
  if (set < 0) return false;
  landlock_path_beneath_attr below{};
  below.allowed_access = allowed;
  below.parent_fd = open(folder.c_str(), O_PATH | O_CLOEXEC);
  const bool done = below.parent_fd >= 0 &&
                    syscall(SYS_landlock_add_rule, set, LANDLOCK_RULE_PATH_BENEATH, &below, 0) == 0 &&
                    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && syscall(SYS_landlock_restrict_self, set, 0) == 0;
  if (below.parent_fd >= 0) close(below.parent_fd);
  close(set);
  return done;
}

}  // namespace btr::openr
