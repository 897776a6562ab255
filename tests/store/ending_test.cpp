// A call of a connection that reads ends when another thread wants it to.
#include <sqlite3.h>

#include <atomic>
#include <thread>

#include "tests/store/store_fixture.h"

namespace btr {
namespace {

class EndingOfACall : public StoreTest {};

// The patience is ten minutes: only the flag can end it.
TEST_F(EndingOfACall, AlsoOfOneThatWaitsForALock) {
  { create(); }
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(file().c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr), SQLITE_OK);
  std::atomic<bool> stop = false;
  Database reader = Database::open(file(), Database::Mode::readOnly, 600'000);
  reader.endWhen(stop);
  EXPECT_TRUE(reader.runs().empty());
  ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  std::thread ends([&] { stop = true; });
  EXPECT_THROW(reader.runs(), InputError);
  ends.join();
  ASSERT_EQ(sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr), SQLITE_OK);
  stop = false;
  EXPECT_TRUE(reader.runs().empty());
  sqlite3_close(other);
}

TEST_F(EndingOfACall, APatienceThatIsOverEndsItToo) {
  { create(); }
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(file().c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr), SQLITE_OK);
  const std::atomic<bool> never = false;
  Database reader = Database::open(file(), Database::Mode::readOnly, 20);
  reader.endWhen(never);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_THROW(reader.runs(), InputError);
  sqlite3_close(other);
}

}  // namespace
}  // namespace btr
