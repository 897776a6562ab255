// Every file that is not a sound database of ours is refused with one clear sentence and left as it was.
#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/stat.h>

#include <fstream>
#include <set>

#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/store/migrations.h"
#include "tests/store/processes.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Mode = Database::Mode;

class Opening : public StoreTest {
 protected:
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) all.insert(entry.path().filename());
    return all;
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(pathOf(name), std::ios::binary) << content;
  }
  // Refused in every mode, with the same sentence, and neither file nor folder changes.
  std::string refusedUnchanged(const std::string& path) const {
    const bool regular = std::filesystem::is_regular_file(path);
    const std::string before = regular ? readFile(path) : "";
    const std::set<std::string> namesBefore = names();
    std::string message;
    for (const Mode mode : {Mode::readOnly, Mode::readWrite, Mode::create}) {
      const std::string answer = refusal([&] { Database::open(path, mode); });
      EXPECT_TRUE(message.empty() || message == answer) << message << "\n" << answer;
      message = answer;
    }
    EXPECT_EQ(namesBefore, names());
    EXPECT_TRUE(!regular || before == readFile(path)) << path << " has changed";
    EXPECT_THAT(message, StartsWith(path + ": "));
    EXPECT_EQ(std::string::npos, message.find('\n'));
    return message.substr(path.size() + 2);
  }
  void fill(int generations) const {
    Database database = create();
    const Id run = startRun(database);
    for (int number = 1; number <= generations; ++number) {
      GenerationRecord generation = generationOf(run, number);
      database.addGeneration(generation);
    }
  }
};

TEST_F(Opening, AnAbsentFileIsMadeOnlyWhenAskedFor) {
  EXPECT_EQ(file() + ": there is no such file", refusal([&] { Database::open(file(), Mode::readOnly); }));
  EXPECT_EQ(file() + ": there is no such file", refusal([&] { Database::open(file(), Mode::readWrite); }));
  EXPECT_TRUE(names().empty());
  create();
  EXPECT_EQ((std::set<std::string>{"kick.db"}), names());
  EXPECT_TRUE(Database::open(file(), Mode::readOnly).experiments().empty());
}

TEST_F(Opening, TheFileIsMarkedAsOursAndUsesAWriteAheadLog) {
  create();
  SQLite::Database raw(file(), SQLite::OPEN_READONLY);
  EXPECT_EQ(0x55434853, raw.execAndGet("PRAGMA application_id").getInt());
  EXPECT_EQ(static_cast<int>(migrations().size()), raw.execAndGet("PRAGMA user_version").getInt());
  EXPECT_EQ("wal", raw.execAndGet("PRAGMA journal_mode").getString());
  SQLite::Statement table(raw,
                          "SELECT name FROM pragma_table_list WHERE schema = 'main' AND type = 'table' AND "
                          "name NOT LIKE 'sqlite_%' AND NOT strict");
  EXPECT_FALSE(table.executeStep()) << "every table is STRICT";
}

TEST_F(Opening, PlacesThatHoldNoFileAreNamed) {
  EXPECT_THAT(refusedUnchanged(folder_), HasSubstr("is a folder"));
  EXPECT_THAT(refusal([&] { Database::open(pathOf("no/where.db"), Mode::create); }), HasSubstr("there is no folder"));
  ASSERT_EQ(0, mkfifo(pathOf("pipe").c_str(), 0600));
  EXPECT_THAT(refusedUnchanged(pathOf("pipe")), HasSubstr("is not a regular file"));
  EXPECT_EQ("database: no file is named", refusal([&] { Database::open("", Mode::create); }));
}

TEST_F(Opening, NamesThatMeanSomethingToSqliteAreOrdinaryFiles) {
  for (const char* name : {":memory:", "file:x?mode=memory", "per%cent #1?.db", "ü µ.db"}) {
    Database::open(pathOf(name), Mode::create).addExperiment(kickExperiment());
    EXPECT_TRUE(std::filesystem::exists(pathOf(name))) << name;
    EXPECT_EQ(1u, Database::open(pathOf(name), Mode::readOnly).experiments().size()) << name;
  }
}

TEST_F(Opening, ALinkLeadsToTheFileAndItsLog) {
  fill(1);
  std::filesystem::create_directory(pathOf("elsewhere"));
  std::filesystem::create_symlink(file(), pathOf("elsewhere/link.db"));
  Database through = Database::open(pathOf("elsewhere/link.db"), Mode::readWrite);
  through.setRunNote(1, "through the link");
  EXPECT_EQ("through the link", Database::open(file(), Mode::readOnly).run(1).note);
  EXPECT_EQ(1, std::distance(std::filesystem::directory_iterator(pathOf("elsewhere")), {}));
}

TEST_F(Opening, ForeignFilesAreRefused) {
  write("empty.db", "");
  EXPECT_THAT(refusedUnchanged(pathOf("empty.db")), StartsWith("is empty"));
  write("note.db", "Dear diary");
  EXPECT_THAT(refusedUnchanged(pathOf("note.db")), StartsWith("is not a database"));
  write("long.db", std::string(100000, 'x'));
  EXPECT_THAT(refusedUnchanged(pathOf("long.db")), StartsWith("is not a database"));

  for (const char* journal : {"DELETE", "WAL"}) {
    for (const int application : {0, 0x47504b47}) {
      const std::string path = pathOf("other" + std::string(journal) + std::to_string(application) + ".db");
      {
        SQLite::Database other(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        other.exec("PRAGMA journal_mode = " + std::string(journal));
        other.exec("PRAGMA application_id = " + std::to_string(application) + "; CREATE TABLE experiment (id)");
      }
      EXPECT_THAT(refusedUnchanged(path),
                  HasSubstr("of another program (application id " + std::to_string(application) + ")"));
    }
  }
}

TEST_F(Opening, AForeignFileWithALogKeepsBoth) {
  // The other program was killed: its last changes stand in the log only.
  const std::string path = pathOf("other.db");
  inAnotherProcess([&]() -> std::string {
    SQLite::Database other(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    other.exec("PRAGMA journal_mode = WAL; CREATE TABLE t (x); INSERT INTO t VALUES (1)");
    _exit(0);
  });
  const std::string log = readFile(path + "-wal");
  ASSERT_FALSE(log.empty());
  EXPECT_THAT(refusedUnchanged(path), HasSubstr("another program"));
  EXPECT_TRUE(log == readFile(path + "-wal"));
}

TEST_F(Opening, ANewerFileIsRefused) {
  fill(1);
  const int newer = static_cast<int>(migrations().size()) + 1;
  SQLite::Database(file(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = " + std::to_string(newer));
  EXPECT_THAT(refusedUnchanged(file()), StartsWith("was written by a newer UCHILSIM (schema " + std::to_string(newer)));
}

TEST_F(Opening, ANewerVersionThatStandsInTheLogOnlyIsSeenToo) {
  fill(1);
  inAnotherProcess([&]() -> std::string {
    SQLite::Database newer(file(), SQLite::OPEN_READWRITE);
    newer.exec("PRAGMA user_version = 1000");
    _exit(0);
  });
  const std::string log = readFile(file() + "-wal");
  ASSERT_FALSE(log.empty());
  EXPECT_THAT(refusedUnchanged(file()), StartsWith("was written by a newer UCHILSIM (schema 1000"));
  EXPECT_TRUE(log == readFile(file() + "-wal"));
}

TEST_F(Opening, AnOlderFileIsBroughtUpToDateWhenItMayBeWritten) {
  SQLite::Database(file(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("PRAGMA application_id = " + std::to_string(applicationId));
  EXPECT_THAT(refusal([&] { Database::open(file(), Mode::readOnly); }), HasSubstr("was written by an older UCHILSIM"));
  EXPECT_EQ("accepted",
            refusal([&] { startRun(*std::make_unique<Database>(Database::open(file(), Mode::readWrite))); }));
  EXPECT_EQ(1u, Database::open(file(), Mode::readOnly).runs().size());
}

TEST_F(Opening, ATruncatedFileIsRefused) {
  fill(20);
  const std::string whole = readFile(file());
  for (const double share : {0.02, 0.3, 0.5, 0.9, 0.999}) {
    write("cut.db", whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    EXPECT_THAT(refusedUnchanged(pathOf("cut.db")), StartsWith("is damaged ("));
  }
}

TEST_F(Opening, OverwrittenPagesAreRefused) {
  fill(20);
  const std::string whole = readFile(file());
  const std::size_t page = 4096;
  Random random(11);
  for (std::size_t at = 4 * page; at + page <= whole.size(); at += 7 * page) {
    std::string damaged = whole;
    for (std::size_t k = 0; k < page; ++k) damaged[at + k] = static_cast<char>(random.below(256));
    write("noise.db", damaged);
    EXPECT_THAT(refusedUnchanged(pathOf("noise.db")), StartsWith("is damaged (")) << "page " << at / page + 1;
  }
}

TEST_F(Opening, AFewWrongBytesAnywhereNeverDoWorseThanAnError) {
  fill(8);
  const std::string whole = readFile(file());
  Random random(12);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole;
    for (std::uint64_t k = random.below(12) + 1; k > 0; --k)
      damaged[100 + random.below(whole.size() - 100)] = static_cast<char>(random.below(256));
    write("noise.db", damaged);
    const std::string answer = refusal([&] {
      const Database database = Database::open(pathOf("noise.db"), Mode::readOnly);
      for (const RunRecord& listed : database.runs()) {
        const RunRecord run = database.run(listed.id);
        database.lastGeneration(run.id);
        database.individuals(run.id);
        database.bestIndividuals(run.id, 10, 1, 0);
        database.simulators(run.id);
        database.gaps(run.id);
      }
    });
    if (answer != "accepted") ++refused;
  }
  EXPECT_GT(refused, 20);
}

TEST_F(Opening, WhatTheUserMayNotReadOrWriteIsNamed) {
  fill(1);
  chmod(folder_.c_str(), 0777);
  const auto answer = [&](Mode mode) {
    return inAnotherProcess([&] { return refusal([&] { Database::open(file(), mode); }); }, true);
  };
  chmod(file().c_str(), 0000);
  for (const Mode mode : {Mode::readOnly, Mode::readWrite, Mode::create})
    EXPECT_EQ(
        file() + ": cannot be opened (Permission denied); file and folder must be readable, for changes also writable",
        answer(mode));
  chmod(file().c_str(), 0444);
  EXPECT_EQ(file() + ": is read-only; make the file writable or open it for reading", answer(Mode::readWrite));
  EXPECT_EQ("accepted", answer(Mode::readOnly));
}

TEST_F(Opening, InAFolderThatCannotBeWrittenADatabaseCanBeReadAndNothingElse) {
  fill(3);
  chmod(file().c_str(), 0666);
  chmod(folder_.c_str(), 0555);
  const auto said = [&](const std::function<std::string()>& work) { return inAnotherProcess(work, true); };
  EXPECT_EQ("3", said([&] { return std::to_string(Database::open(file(), Mode::readOnly).generations(1).size()); }));
  EXPECT_THAT(said([&] { return refusal([&] { Database::open(file(), Mode::readWrite); }); }),
              HasSubstr("cannot be changed: file or folder is read-only"));
  EXPECT_THAT(said([&] { return refusal([&] { Database::open(pathOf("new.db"), Mode::create); }); }),
              HasSubstr("new.db: cannot be created in " + folder_.string() + " (Permission denied)"));
  chmod(folder_.c_str(), 0755);
  EXPECT_EQ((std::set<std::string>{"kick.db"}), names());
}

TEST_F(Opening, AReaderLeavesNoFilesBehind) {
  fill(1);
  const std::string before = readFile(file());
  { EXPECT_EQ(1u, Database::open(file(), Mode::readOnly).runs().size()); }
  EXPECT_TRUE(before == readFile(file()));
  EXPECT_EQ((std::set<std::string>{"kick.db"}), names());
}

TEST(Migrations, RunOnceInOrderAndAllOrNone) {
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  const Migration second{
      "a column", [](SQLite::Database& d) { d.exec("ALTER TABLE t ADD COLUMN y; INSERT INTO t VALUES (1, 2)"); }};
  const Migration broken{"does not work", [](SQLite::Database& d) {
                           d.exec("INSERT INTO t VALUES (3, 4); INSERT INTO nothing VALUES (1)");
                         }};
  const Migration table{"a table", [](SQLite::Database& d) { d.exec("CREATE TABLE t (x)"); }};
  migrate(database, std::array{table});
  EXPECT_EQ(1, database.execAndGet("PRAGMA user_version").getInt());
  EXPECT_THROW(migrate(database, std::array{table, second, broken}), SQLite::Exception);
  EXPECT_EQ(1, database.execAndGet("PRAGMA user_version").getInt());
  migrate(database, std::array{table, second});
  migrate(database, std::array{table, second});
  EXPECT_EQ(2, database.execAndGet("PRAGMA user_version").getInt());
  EXPECT_EQ(1, database.execAndGet("SELECT count(*) FROM t").getInt());
}

}  // namespace
}  // namespace btr
