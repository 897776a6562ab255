// Killed at any moment, or with a full disk: what was stored stays sound and whole.
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/spec/random.h"
#include "tests/store/processes.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;
using Mode = Database::Mode;

class Durability : public StoreTest {
 protected:
  // Generations 1, 2, … of which each is whole and as it was made. Returns their count.
  int checkWhole() const {
    const Database database = Database::open(file(), Mode::readOnly);
    const auto generations = database.generations(1);
    const int count = static_cast<int>(generations.size());
    EXPECT_EQ(count, database.run(1).generation);
    for (int number = 1; number <= count; ++number) {
      EXPECT_EQ(number, generations[static_cast<std::size_t>(number) - 1].number);
      const GenerationRecord expected = generationOf(1, number);
      const auto individuals = database.individuals(1, number);
      EXPECT_EQ(expected.individuals.size(), individuals.size());
      if (expected.individuals.size() != individuals.size()) return count;
      for (std::size_t slot = 0; slot < individuals.size(); ++slot) {
        EXPECT_EQ(expected.individuals[slot].chromosome, individuals[slot].chromosome);
        EXPECT_EQ(expected.individuals[slot].fitness, individuals[slot].fitness);
      }
    }
    const auto last = database.lastGeneration(1);
    EXPECT_EQ(count > 0 ? "learner " + std::to_string(count) : "", last ? last->learnerState : "");
    return count;
  }

  // Opens or creates the database and adds generations for ever; writes each number that is stored to `announce`.
  [[noreturn]] void learnForEver(int announce) const {
    Database database = create();
    if (!database.latestRun()) {
      // Experiment and run are two calls: a kill between them leaves an experiment without runs.
      const auto experiments = database.experiments();
      database.addRun(runOf(experiments.empty() ? database.addExperiment(kickExperiment()) : experiments[0].id), {});
    }
    for (int number = database.run(1).generation + 1;; ++number) {
      GenerationRecord generation = generationOf(1, number);
      database.addGeneration(generation);
      if (write(announce, &number, sizeof number) != sizeof number) _exit(3);
    }
  }
};

TEST_F(Durability, ARunKilledAtSixtyRandomTimesKeepsWholeGenerationsAndAllThatWereAnnounced) {
  Random random(50);
  int stored = 0, grown = 0;
  for (int kill = 0; kill < 60; ++kill) {
    int ends[2];
    ASSERT_EQ(0, pipe(ends));
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      learnForEver(ends[1]);
    }
    close(ends[1]);
    // The first kills fall anywhere in making and opening the database, the others anywhere in the writing.
    int announced = stored, number = 0;
    if (kill >= 15 && read(ends[0], &number, sizeof number) == sizeof number) announced = number;
    usleep(static_cast<useconds_t>(random.below(20'000)));
    ::kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "the writer must be alive until it is killed";
    while (read(ends[0], &number, sizeof number) == sizeof number) announced = number;
    close(ends[0]);

    if (!std::filesystem::exists(file())) continue;
    ASSERT_EQ("ok", integrityOf(file())) << "kill " << kill;
    if (!Database::open(file(), Mode::readWrite).latestRun()) continue;
    const int now = checkWhole();
    ASSERT_GE(now, announced) << "kill " << kill;
    ASSERT_LE(now, announced + 1) << "kill " << kill;
    grown += now > stored;
    stored = now;
  }
  EXPECT_GE(grown, 45) << "the later kills hit a run that writes";
}

// Adds generations until one is refused; returns the refusal and how many are stored by the connection's own account.
std::string fillUp(Database& database, int& stored) {
  for (stored = database.run(1).generation;; ++stored) {
    GenerationRecord generation = generationOf(1, stored + 1);
    const std::string answer = refusal([&] { database.addGeneration(generation); });
    if (answer != "accepted") return answer;
  }
}

TEST_F(Durability, AFullDiskStopsTheRunAndSpoilsNothing) {
  { startRun(*std::make_unique<Database>(create())); }
  // Several sizes, so that the limit is met in the log, in the file, and within a page.
  Random random(7);
  int last = 0;
  for (int round = 0; round < 12; ++round) {
    const std::string answer = inAnotherProcess([&] {
      signal(SIGXFSZ, SIG_IGN);
      Database database = Database::open(file(), Mode::readWrite);
      rlimit limit{};
      getrlimit(RLIMIT_FSIZE, &limit);
      const rlim_t hard = limit.rlim_max;
      limit.rlim_cur = std::filesystem::file_size(file()) + 20'000 + random.below(300'000);
      setrlimit(RLIMIT_FSIZE, &limit);
      int stored = 0;
      std::string said = fillUp(database, stored);
      // Reading goes on, and with room again writing does too.
      if (database.run(1).generation != stored) said += " BUT THE COUNT IS WRONG";
      limit.rlim_cur = hard;
      setrlimit(RLIMIT_FSIZE, &limit);
      GenerationRecord generation = generationOf(1, stored + 1);
      database.addGeneration(generation);
      return std::to_string(stored + 1) + said;
    });
    for (std::uint64_t k = random.below(5); k > 0; --k) random.next();
    EXPECT_THAT(answer, HasSubstr("kick.db: disk full: nothing of this step was stored"));
    EXPECT_THAT(answer, testing::Not(HasSubstr("BUT")));
    EXPECT_EQ("ok", integrityOf(file()));
    const int stored = checkWhole();
    EXPECT_EQ(stored, std::atoi(answer.c_str()));
    EXPECT_GT(stored, last);
    last = stored;
  }
}

TEST_F(Durability, WithoutRoomForItADatabaseIsNotMade) {
  const std::string answer = inAnotherProcess([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10'000, 10'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    return refusal([&] { create(); });
  });
  EXPECT_THAT(answer, HasSubstr("kick.db: disk full"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_)) << "no half-made file is left";
}

TEST_F(Durability, ASmallFileSystemThatFillsUpSpoilsNothing) {
  const std::string answer = inAnotherProcess([&]() -> std::string {
    // A file system of 400 kB in a name space of its own.
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=400k") != 0)
      return "NOT PERMITTED";
    int stored = 0;
    std::string said;
    {
      Database database = create();
      startRun(database);
      said = fillUp(database, stored);
    }
    // Opened anew on the full disk.
    if (checkWhole() != stored || stored == 0) return "LOST " + said;
    if (integrityOf(file()) != "ok") return "NOT SOUND " + said;
    return said;
  });
  if (answer == "NOT PERMITTED") GTEST_SKIP() << "mounting needs special rights";
  EXPECT_THAT(answer, HasSubstr("kick.db: disk full: nothing of this step was stored"));
  EXPECT_THAT(answer, testing::StartsWith(folder_.string()));
}

TEST_F(Durability, ALogThatAKilledProcessLeftIsRead) {
  ASSERT_EQ("DIED", inAnotherProcess([&]() -> std::string {
              Database database = create();
              startRun(database);
              for (int number = 1; number <= 5; ++number) {
                GenerationRecord generation = generationOf(1, number);
                database.addGeneration(generation);
              }
              raise(SIGKILL);
              return "";
            }));
  ASSERT_GT(std::filesystem::file_size(file() + "-wal"), 0u);
  EXPECT_EQ(5, checkWhole());
  EXPECT_EQ("ok", integrityOf(file()));
}

TEST_F(Durability, ALogWithATornEndLosesOnlyItsLastGenerations) {
  ASSERT_EQ("DIED", inAnotherProcess([&]() -> std::string {
              Database database = create();
              startRun(database);
              for (int number = 1; number <= 20; ++number) {
                GenerationRecord generation = generationOf(1, number);
                database.addGeneration(generation);
              }
              raise(SIGKILL);
              return "";
            }));
  const std::string log = file() + "-wal";
  const auto size = std::filesystem::file_size(log);
  std::filesystem::resize_file(log, size - 3000);
  EXPECT_EQ(19, checkWhole());
  EXPECT_EQ("ok", integrityOf(file()));
}

}  // namespace
}  // namespace btr
