#include "core/spec/utf8.h"

#include <gtest/gtest.h>

#include "tests/refusal.h"

namespace btr {
namespace {

TEST(Utf8, TakesEveryShortestFormUpToTheLastCharacter) {
  for (const char* text : {"", "a", "\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                           "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF", "Größe [m²] 😀"})
    EXPECT_EQ(std::string_view::npos, findInvalidUtf8(text)) << text;
}

TEST(Utf8, FindsTheFirstByteThatIsNoCharacter) {
  EXPECT_EQ(0u, findInvalidUtf8("\xE9"));
  EXPECT_EQ(1u, findInvalidUtf8("a\xFF"));
  EXPECT_EQ(2u, findInvalidUtf8("é\x80"));     // continues nothing
  EXPECT_EQ(0u, findInvalidUtf8("\xC0\x80"));  // longer than needed
  EXPECT_EQ(0u, findInvalidUtf8("\xE0\x9F\xBF"));
  EXPECT_EQ(0u, findInvalidUtf8("\xF0\x8F\xBF\xBF"));
  EXPECT_EQ(0u, findInvalidUtf8("\xED\xA0\x80"));      // a surrogate
  EXPECT_EQ(0u, findInvalidUtf8("\xF4\x90\x80\x80"));  // beyond U+10FFFF
  EXPECT_EQ(1u, findInvalidUtf8("a\xE2\x82"));         // ends in the middle
}

TEST(Utf8, SaysWhereAndWhichByte) {
  EXPECT_EQ("note: the byte 0xFE (number 3 of the text) is not allowed; text in UTF-8",
            test::refusal([] { requireUtf8("ab\xFE", "note"); }));
  EXPECT_EQ("accepted", test::refusal([] { requireUtf8("né", "note"); }));
}

}  // namespace
}  // namespace btr
