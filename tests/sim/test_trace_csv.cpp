// A trace as text is read again, whatever its joints are called.
#include <gtest/gtest.h>

#include <sstream>

#include "core/sim/trace.h"
#include "core/spec/csv.h"

namespace btr::test {
namespace {

TEST(TraceCsv, HeadingsAreReadAsTheyWere) {
  Trace trace;
  trace.channels = {"time_s", "robot.j\"1.position_rad", "robot.left,knee.position_rad", "robot. a.position_rad"};
  trace.values = {0, 1, 2, 3, 0.008, 4, 5, 6};
  std::istringstream text(trace.toCsv());
  CsvReader reader(text, "trace.csv");
  std::vector<std::string> row;
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(trace.channels, row);
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ((std::vector<std::string>{"0", "1", "2", "3"}), row);
}

}  // namespace
}  // namespace btr::test
