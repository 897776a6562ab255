#include "core/cluster/own_scratch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/spec/system/scratch_folder.h"
#include "tests/temporary_folder.h"

namespace {

using namespace btr;

TEST(OwnScratch, OfAProcessThatWasKilledIsRemovedAndNoOther) {
  const TemporaryFolder folder;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  setenv("TMPDIR", folder.path().c_str(), 1);
  const pid_t gone = fork();
  if (gone == 0) {
    new ScratchFolder(ownScratchName("case"));  // nobody removes it
    _exit(0);
  }
  waitpid(gone, nullptr, 0);
  {
    const ScratchFolder ours(ownScratchName("case")), other("uchilsim-case-of-somebody");
    EXPECT_EQ(3, std::distance(std::filesystem::directory_iterator(folder.path()), {}));
    removeAbandonedScratch("case");
    EXPECT_EQ(2, std::distance(std::filesystem::directory_iterator(folder.path()), {}));
    EXPECT_TRUE(std::filesystem::exists(ours.path()));
    EXPECT_TRUE(std::filesystem::exists(other.path()));
  }
  kept.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
}

}  // namespace
