// A backup is one state of the database, whole and checked, whatever others do meanwhile; a typed value is in the file.
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "core/spec/json_reader.h"
#include "core/store/network_file.h"
#include "tests/store/processes.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Mode = Database::Mode;

class Backup : public StoreTest {
 protected:
  std::string copy() const { return pathOf("copy.db"); }
  void fill(int generations) const {
    Database database = create();
    const Id run = startRun(database);
    for (int number = 1; number <= generations; ++number) {
      GenerationRecord generation = generationOf(run, number);
      database.addGeneration(generation);
    }
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) all.push_back(entry.path().filename());
    std::ranges::sort(all);
    return all;
  }
};

TEST_F(Backup, WhileAnotherProcessWritesEveryCopyIsWholeAndLaterOnesHoldMore) {
  fill(1);
  int stop[2], begun[2];
  ASSERT_EQ(0, pipe(stop));
  ASSERT_EQ(0, pipe(begun));
  const pid_t writer = fork();
  if (writer == 0) {
    close(stop[1]);
    Database database = Database::open(file(), Mode::readWrite);
    for (int number = 2;; ++number) {
      GenerationRecord generation = generationOf(1, number);
      database.addGeneration(generation);
      if (write(begun[1], &number, sizeof number) != sizeof number) _exit(1);
    }
  }
  close(begun[1]);
  int last = 0;
  for (int k = 0; k < 5; ++k) {
    int written = 0;
    while (written <= last) ASSERT_EQ(ssize_t{sizeof written}, read(begun[0], &written, sizeof written));
    const std::string to = pathOf("copy" + std::to_string(k) + ".db");
    EXPECT_GT(Database::open(file(), Mode::readOnly).backUp(to, false), 0);
    const Database taken = Database::open(to, Mode::readOnly);
    EXPECT_TRUE(taken.findings().empty());
    const int count = taken.run(1).generation;
    EXPECT_GT(count, last);
    EXPECT_EQ(static_cast<std::size_t>(30 * count), taken.individuals(1).size()) << "generations are whole";
    last = count;
  }
  kill(writer, SIGKILL);
  waitpid(writer, nullptr, 0);
}

TEST_F(Backup, TheCopyIsOneFileThatHoldsWhatStillStandsInTheLog) {
  fill(3);
  const Database keepsTheLog = Database::open(file(), Mode::readWrite);
  Database(Database::open(file(), Mode::readWrite)).setRunNote(1, "in the log");
  ASSERT_TRUE(std::filesystem::exists(file() + "-wal"));
  keepsTheLog.backUp(copy(), false);
  EXPECT_THAT(names(), ElementsAre("copy.db", "kick.db", "kick.db-shm", "kick.db-wal"));
  EXPECT_EQ("in the log", Database::open(copy(), Mode::readOnly).run(1).note);
}

TEST_F(Backup, AFileThatIsThereIsReplacedOnlyWhenAskedFor) {
  fill(2);
  const Database database = Database::open(file(), Mode::readWrite);
  std::ofstream(copy()) << "Dear diary";
  EXPECT_EQ(copy() + ": is there already; choose another name, or --force to replace it",
            refusal([&] { database.backUp(copy(), false); }));
  EXPECT_EQ("Dear diary", readFile(copy()));
  database.backUp(copy(), true);
  EXPECT_EQ(2, Database::open(copy(), Mode::readOnly).run(1).generation);
  EXPECT_THAT(refusal([&] { database.backUp(file(), true); }), HasSubstr("is the database itself"));
  EXPECT_THAT(refusal([&] { database.backUp(folder_, true); }), HasSubstr("is a folder"));
  EXPECT_THAT(refusal([&] { database.backUp(pathOf("no/copy.db"), true); }), HasSubstr("there is no folder"));
  const Database used = Database::open(copy(), Mode::readWrite);
  used.experiments();
  Database(Database::open(copy(), Mode::readWrite)).setRunNote(1, "used");
  EXPECT_THAT(refusal([&] { database.backUp(copy(), true); }), HasSubstr("is in use"));
}

TEST_F(Backup, AFullDiskIsSaidAndLeavesNoCopy) {
  fill(20);
  const std::string answer = inAnotherProcess([&] {
    const Database database = Database::open(file(), Mode::readOnly);
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100 * 1024, 100 * 1024};
    setrlimit(RLIMIT_FSIZE, &limit);
    return refusal([&] { database.backUp(copy(), false); });
  });
  EXPECT_EQ(copy() + ": disk full: no copy was made; make room or choose another place", answer);
  EXPECT_THAT(names(), ElementsAre("kick.db"));
}

TEST_F(Backup, WhatWasStoredIsInTheFileItselfThoughAnotherProcessHoldsItOpen) {
  fill(1);
  const Database reader = Database::open(file(), Mode::readOnly);
  reader.experiments();
  Database database = Database::open(file(), Mode::readWrite);
  database.setRunNote(1, "typed");
  EXPECT_TRUE(database.moveLogIntoFile());
  std::filesystem::copy_file(file(), copy());
  EXPECT_EQ("typed", Database::open(copy(), Mode::readOnly).run(1).note);
}

TEST_F(Backup, AReaderOfAnOlderStateKeepsTheLogAndThatIsSaid) {
  fill(1);
  Database database = Database::open(file(), Mode::readWrite);
  SQLite::Database reader(file(), SQLite::OPEN_READONLY);
  reader.exec("BEGIN; SELECT count(*) FROM run");
  SQLite::Statement row(reader, "SELECT count(*) FROM individual");
  ASSERT_TRUE(row.executeStep());
  database.setRunNote(1, "typed");
  EXPECT_FALSE(database.moveLogIntoFile(50));
  row.reset();
  reader.exec("COMMIT");
  EXPECT_TRUE(database.moveLogIntoFile(50));
  EXPECT_EQ("typed", database.run(1).note);
}

TEST_F(Backup, ADamagedReferenceIsFound) {
  fill(1);
  EXPECT_TRUE(Database::open(file(), Mode::readOnly).findings().empty());
  {
    SQLite::Database raw(file(), SQLite::OPEN_READWRITE);
    raw.exec("PRAGMA foreign_keys = OFF; INSERT INTO trace VALUES (999, x'00')");
  }
  EXPECT_THAT(Database::open(file(), Mode::readOnly).findings(),
              ElementsAre("row 999 of trace refers to a row of individual that is missing"));
}

TEST(NetworkFile, FileSystemsOfOtherMachinesHaveANameAndLocalOnesDoNot) {
  EXPECT_EQ("NFS", networkFileSystem(0x6969));
  EXPECT_EQ("CIFS", networkFileSystem(static_cast<long>(0xFF534D42)));
  EXPECT_EQ("CIFS", networkFileSystem(static_cast<int>(0xFF534D42))) << "statfs of 32 bits";
  EXPECT_EQ("", networkFileSystem(0xEF53));      // ext4
  EXPECT_EQ("", networkFileSystem(0x01021994));  // tmpfs
  EXPECT_FALSE(networkWarning("/dev/shm/not_there.db"));
}

}  // namespace
}  // namespace btr
