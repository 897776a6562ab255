#include "core/spec/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/refusal.h"

namespace btr {
namespace {

using Row = std::vector<std::string>;
using testing::HasSubstr;

std::vector<Row> rowsOf(const std::string& text, CsvLimits limits = {}, std::vector<long>* lines = nullptr) {
  std::istringstream stream(text);
  CsvReader reader(stream, "table.csv", ',', limits);
  std::vector<Row> rows;
  for (Row row; reader.next(row);) {
    rows.push_back(row);
    if (lines) lines->push_back(reader.line());
  }
  return rows;
}

std::string refusalOf(const std::string& text, CsvLimits limits = {}) {
  return test::refusal([&] { rowsOf(text, limits); });
}

TEST(CsvReader, ReadsRowsWithEitherLineEndingAndNoneAtTheEnd) {
  const std::vector<Row> expected{{"a", "b"}, {"1", ""}, {"", "2"}};
  EXPECT_EQ(expected, rowsOf("a,b\n1,\n,2\n"));
  EXPECT_EQ(expected, rowsOf("a,b\r\n1,\r\n,2"));
  EXPECT_EQ(expected, rowsOf("a,b\r1,\r,2\r"));
}

TEST(CsvReader, RefusesTextThatIsNotUtf8WithLineAndColumn) {
  EXPECT_EQ((std::vector<Row>{{"é", "m²"}}), rowsOf("é,m²\n"));
  EXPECT_THAT(refusalOf("a,b\n1,d\xE9rap\n"),
              HasSubstr("table.csv line 2, column 2: the byte 0xE9 (number 2 of the text)"));
  EXPECT_THAT(refusalOf("a,\"\xFF\"\n"), HasSubstr("line 1, column 2"));
}

TEST(CsvReader, KeepsSeparatorsQuotesAndLineBreaksOfQuotedFields) {
  EXPECT_EQ((std::vector<Row>{{"a,b", "say \"no\"", "x\r\ny", ""}}),
            rowsOf("\"a,b\",\"say \"\"no\"\"\",\"x\r\ny\",\"\"\n"));
}

TEST(CsvReader, SkipsTheByteOrderMarkAndEmptyLinesButCountsTheLines) {
  std::vector<long> lines;
  EXPECT_EQ((std::vector<Row>{{"a"}, {"b\nc"}, {"d"}}), rowsOf("\xEF\xBB\xBF\r\n\na\r\n\n\"b\nc\"\n\n\nd", {}, &lines));
  EXPECT_EQ((std::vector<long>{3, 5, 9}), lines);
}

TEST(CsvReader, PassesOverCommentsAndWhatItIsToldTo) {
  std::istringstream stream("\xEF\xBB\xBFmade by \"hand\n\n# a,b\n1,2\n# \"three\n\"# 3\",4\n%\n");
  CsvReader reader(stream, "table.csv");
  reader.skipLine();
  reader.skipLine();
  reader.skipBytes(2);
  std::vector<std::string> row;
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(row, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(reader.line(), 3);
  reader.passOver("#%");
  ASSERT_TRUE(reader.next(row));
  EXPECT_FALSE(reader.atEnd());
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(row, (std::vector<std::string>{"# 3", "4"}));
  EXPECT_EQ(reader.line(), 6);
  EXPECT_FALSE(reader.next(row));
  EXPECT_TRUE(reader.atEnd());
  EXPECT_EQ(reader.comments(), 2u);
}

TEST(CsvReader, FindsNothingInAnEmptyText) {
  EXPECT_TRUE(rowsOf("").empty());
  EXPECT_TRUE(rowsOf("\n\r\n\xEF\xBB\xBF").size() == 1);  // a mark that does not open the file is content
  EXPECT_TRUE(rowsOf("\xEF\xBB\xBF").empty());
}

TEST(CsvReader, NamesLineAndColumnOfBrokenQuotes) {
  EXPECT_THAT(refusalOf("a,b\n1,\"2\n3"), HasSubstr("table.csv line 2, column 2: the quote"));
  EXPECT_THAT(refusalOf("a,b\n1,2\"3\n"), HasSubstr("table.csv line 2, column 2: a quote inside"));
  EXPECT_THAT(refusalOf("\"a\"b,c\n"), HasSubstr("table.csv line 1, column 1: text behind"));
}

TEST(CsvReader, RefusesBinaryFilesAndFilesBeyondTheLimits) {
  EXPECT_THAT(refusalOf(std::string("a,b\n1,\0002\n", 9)), HasSubstr("line 2, column 2: a NUL byte"));
  EXPECT_THAT(refusalOf("a,abcdef\n", {.fieldBytes = 5}), HasSubstr("line 1, column 2: more than 5 bytes"));
  EXPECT_THAT(refusalOf("a,b,c\n", {.fields = 2}), HasSubstr("line 1: more than 2 columns"));
  EXPECT_THAT(refusalOf("a,b\n1,2\n", {.bytes = 7}), HasSubstr("more than 7 bytes"));
  EXPECT_EQ("accepted", refusalOf("a,abcde\n1,2\n", {.bytes = 12, .fieldBytes = 5, .fields = 2}));
}

TEST(CsvReader, ReadsAcrossItsOwnBuffer) {
  std::string text;
  std::vector<Row> expected;
  for (int i = 0; i < 30000; ++i) {
    expected.push_back({std::to_string(i), "x,\"" + std::to_string(i * 7)});
    text += csvField(expected.back()[0]) + "," + csvField(expected.back()[1]) + "\r\n";
  }
  EXPECT_EQ(expected, rowsOf(text));
}

TEST(CsvField, ReadsBackAsTheSameText) {
  for (const std::string text : {"", "plain", "a,b", "\"", "two\nlines", " space ", "tab\t", "semi;colon", "ü µm"})
    EXPECT_EQ((std::vector<Row>{{text, "end"}}), rowsOf(csvField(text) + ",end\n"));
  EXPECT_EQ("plain", csvField("plain"));
}

}  // namespace
}  // namespace btr
