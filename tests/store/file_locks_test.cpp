// What else a process does with its database's files takes no lock away.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using Mode = Database::Mode;

/// Another process that waits until it is told to go on. It was begun before this one opened a database, so it shares
/// nothing of SQLite's with it.
class Other {
 public:
  explicit Other(const std::function<void()>& work) {
    if (pipe(ends_) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ != 0) return;
    char go = 0;
    if (read(ends_[0], &go, 1) != 1) _exit(2);
    try {
      work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
    _exit(0);
  }
  int goOn() {
    if (write(ends_[1], "x", 1) != 1) return -1;
    int status = 0;
    waitpid(child_, &status, 0);
    close(ends_[0]);
    close(ends_[1]);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  int ends_[2];
  pid_t child_ = 0;
};

class FileLocks : public StoreTest {
 protected:
  static void add(Database& database, const std::string& name) {
    database.addExperiment({.id = 0, .name = name, .specJson = "{}", .createdAt = "", .note = ""});
  }
  static std::vector<std::string> names(const Database& database) {
    std::vector<std::string> all;
    for (const ExperimentRecord& e : database.experiments()) all.push_back(e.name);
    return all;
  }
  /// As a file dialog does that chooses icons by content.
  void lookInside() const {
    for (const char* end : {"", "-wal", "-shm"}) {
      const int descriptor = open((file() + end).c_str(), O_RDONLY);
      ASSERT_GE(descriptor, 0) << end;
      close(descriptor);
    }
  }
};

TEST_F(FileLocks, AreKeptWhenSomethingElseInTheProcessReadsTheFiles) {
  create();
  Other other([&] {
    Database theirs = Database::open(file(), Mode::readWrite);
    add(theirs, "theirs");
  });
  Database ours = Database::open(file(), Mode::readWrite);
  const Database watching = Database::open(file(), Mode::readOnly);
  add(ours, "first");
  lookInside();
  // It would remove the log on leaving, if it believed to be the last.
  ASSERT_EQ(other.goOn(), 0);
  EXPECT_EQ(names(watching), (std::vector<std::string>{"first", "theirs"}));
  EXPECT_EQ(names(ours), (std::vector<std::string>{"first", "theirs"}));
  add(ours, "last");
  EXPECT_EQ(names(watching), (std::vector<std::string>{"first", "theirs", "last"}));
  EXPECT_EQ(names(Database::open(file(), Mode::readOnly)), names(ours));
}

TEST_F(FileLocks, EndWithTheLastConnectionWhicheverThatIs) {
  create();
  for (const bool firstLeavesFirst : {true, false}) {
    auto one = std::make_unique<Database>(Database::open(file(), Mode::readWrite));
    auto two = std::make_unique<Database>(Database::open(file(), Mode::readWrite));
    add(*one, "by one");
    add(*two, "by two");
    (firstLeavesFirst ? one : two).reset();
    EXPECT_TRUE(std::filesystem::exists(file() + "-wal"));
    (firstLeavesFirst ? two : one).reset();
    // The last to leave was alone: it put the log away.
    EXPECT_FALSE(std::filesystem::exists(file() + "-wal"));
  }
  EXPECT_EQ(Database::open(file(), Mode::readOnly).experiments().size(), 4u);
}

TEST_F(FileLocks, AreNotHeldByAChildThatOutlivesItsParent) {
  create();
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    // Killed while it writes; its own child lives on until the pipe is closed.
    Database database = Database::open(file(), Mode::readWrite);
    add(database, "of the killed one");
    if (fork() == 0) {
      close(ends[1]);
      char wait = 0;
      _exit(read(ends[0], &wait, 1) == 0 ? 0 : 1);
    }
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(parent, &status, 0);
  {
    Database ours = Database::open(file(), Mode::readWrite, 0);
    add(ours, "ours");
    EXPECT_EQ(names(ours), (std::vector<std::string>{"of the killed one", "ours"}));
  }
  EXPECT_FALSE(std::filesystem::exists(file() + "-wal"));
  close(ends[0]);
  close(ends[1]);
}

TEST_F(FileLocks, LeaveNoDescriptorOpen) {
  const auto count = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  create();
  const auto before = count();
  for (int i = 0; i < 5; ++i) {
    Database one = Database::open(file(), Mode::readWrite);
    const Database two = Database::open(file(), Mode::readOnly);
    add(one, "again");
  }
  EXPECT_EQ(count(), before);
}

}  // namespace
}  // namespace btr
