// What compilers, headers and Makefiles of 2003 let pass: sources that are read anew, and programs as teams wrote them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/openr/builder/robot_longs.h"
#include "core/openr/builder/source_cure.h"
#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SourceCure, DropsTheSecondNameOnly) {
  const std::string source =
      "# 1 \"a.cc\"\nint f(int one, int one);\nint one;\n# 7 \"b.h\"\nint g(int\n two, int x,\n int two);\n";
  const std::string errors =
      "a.cc:1:18: error: redefinition of 'int one'\nb.h:9:5: error: redefinition of 'int two'\nb.h:2:1: error: other\n";
  const std::string cured =
      "# 1 \"a.cc\"\nint f(int one, int );\nint one;\n# 7 \"b.h\"\nint g(int\n two, int x,\n int );\n";
  EXPECT_EQ(withoutRepeatedNames(source, errors), cured);
  EXPECT_EQ(curedSource(source, errors), cured);
}

TEST(SourceCure, ATypeOfATemplatesArgumentIsCalledOne) {
  EXPECT_EQ(curedSource("# 4 \"a.cc\"\nT t; vec::iterator i;\n",
                        "a.cc:4:6: error: need 'typename' before 'vec::iterator' because 'vec' is a dependent scope\n"
                        "a.cc:4:19: error: 'i' was not declared in this scope\n"),
            "# 4 \"a.cc\"\nT t; typename vec::iterator i;\n");
}

TEST(SourceCure, AMemberOfADependentBaseIsSoughtInTheObject) {
  const std::string source = "# 1 \"a.cc\"\nvoid go() { v = 3; }\n";
  const std::string error = "a.cc:1:13: error: 'v' was not declared in this scope\n";
  EXPECT_EQ(curedSource(source, "a.cc: In member function 'void D<T>::go()':\n" + error),
            "# 1 \"a.cc\"\nvoid go() { this->v = 3; }\n");
  EXPECT_EQ(curedSource(source, "a.cc: In function 'void go()':\n" + error), source);  // a mistake stays one
}

TEST(SourceCure, AVariableOfALoopIsKnownBehindIt) {
  const auto cured = [](const std::string& line, const std::string& errors) {
    return curedSource("# 1 \"a.cc\"\n" + line + "\n", errors).substr(std::string("# 1 \"a.cc\"\n").size());
  };
  const auto unknown = [](int column) {
    return "a.cc:1:" + std::to_string(column) + ": error: 'i' was not declared in this scope\n";
  };
  EXPECT_EQ(cured("{ for (int i = 0; i < 3; i++) { say(\"}\"); } use(i); }", unknown(49)),
            "{ int i = 0; for (; i < 3; i++) { say(\"}\"); } use(i); }\n");
  // The nearest loop's; a block has a variable of a name once.
  EXPECT_EQ(cured("{ for (int i = 0; a; ) f(); g(i); for (int i = 5; b; ) f(); g(i); }", unknown(31) + unknown(63)),
            "{ int i = 0; for (; a; ) f(); g(i); for (i = 5; b; ) f(); g(i); }\n");
  // Another function's or an inner block's loop is not meant.
  const std::string other = "{ for (int i = 0; a; ) f(); } { g(i); }";
  EXPECT_EQ(cured(other, unknown(35)), other + "\n");
  const std::string inner = "{ if (x) { for (int i = 0; a; ) f(); } g(i); }";
  EXPECT_EQ(cured(inner, unknown(42)), inner + "\n");
}

TEST(SourceCure, SpecialMembersOfTemplatesAndFriendsAreDeclared) {
  EXPECT_EQ(curedSource("# 1 \"a.cc\"\nT x;\nint V<double>::n = 3;\n",
                        "a.cc:2:5: error: specializing member 'V<double>::n' requires 'template<>' syntax\n"),
            "# 1 \"a.cc\"\nT x;\ntemplate<> int V<double>::n = 3;\n");
  EXPECT_EQ(curedSource("# 1 \"a.cc\"\nint x;\nclass Node { friend class Tree; Tree* owner; };\n",
                        "a.cc:2:33: error: 'Tree' does not name a type\n"),
            "# 1 \"a.cc\"\nint x;\nclass Tree; class Node { friend class Tree; Tree* owner; };\n");
}

TEST(SourceCure, CastsThatAreAssignedToAreOfTheVariable) {
  const std::string lvalue = "error: lvalue required as increment operand\n";
  EXPECT_EQ(curedSource("# 1 \"a.cc\"\n((a::b*)p)++; ++(c d)q; (f(x))++;\n",
                        "a.cc:1:2: " + lvalue + "a.cc:1:16: " + lvalue + "a.cc:1:27: " + lvalue),
            "# 1 \"a.cc\"\n(*(a::b**)&p)++; ++*(c d*)&q; (f(x))++;\n");
}

TEST(SourceCure, FunctionsNamesBetweenLiteralsAreLiterals) {
  EXPECT_EQ(curedSource("# 9 \"a.cc\"\nf(\"in \" __FUNCTION__ \"\\n\", __FUNCTION__);\n",
                        "a.cc: In member function 'virtual void A::go(int) const':\n"
                        "a.cc:9:2: error: expected ')' before '__FUNCTION__'\n"),
            "# 9 \"a.cc\"\nf(\"in \" \"go\" \"\\n\", __FUNCTION__);\n");
}

TEST(SourceCure, LesserAndGreaterAreNamed) {
  const std::string expected = "error: expected primary-expression before '?' token\n";
  EXPECT_EQ(curedSource("# 1 \"a.cc\"\nm <?= f(a, b) ? c : d; x = a >? b;\n",
                        "a.cc:1:4: " + expected + "a.cc:1:31: " + expected),
            "# 1 \"a.cc\"\nm <btr_least>= ( f(a, b) ? c : d); x = a <btr_most> b;\n");
}

TEST(SourceCure, NamesMissingHeadersOnce) {
  EXPECT_THAT(missingHeaders("a.cc:1:1: note: 'strcmp' is defined in header '<cstring>'; did you forget\n"
                             "a.cc:2:1: note: 'strlen' is defined in header '<cstring>'; did you forget\n"
                             "a.cc:3:1: note: 'sort' is defined in header '<algorithm>'; did you\n"),
              ElementsAre("cstring", "algorithm"));
  // Of these the compiler does not say where they are.
  EXPECT_THAT(missingHeaders("a.cc:1:1: error: 'rmdir' was not declared in this scope\n"
                             "a.cc:2:1: error: 'mine' was not declared in this scope\n"),
              ElementsAre("unistd.h"));
  EXPECT_THAT(missingHeaders("a.cc:1:1: error: 'fabs' was not declared in this scope; did you mean 'labs'?\n"
                             "a.cc:1:9: error: 'M_PI' was not declared in this scope\n"
                             "a.cc:2:1: error: 'isdigit' was not declared in this scope\n"),
              ElementsAre("math.h", "ctype.h"));
  EXPECT_THAT(missingHeaders("a.cc:1:1: error: 'setw' was not declared in this scope; did you mean 'getw'?\n"
                             "a.cc:2:1: error: 'sort' is not a member of 'std'; did you mean 'qsort'?\n"
                             "a.cc:3:1: error: aggregate 'std::stringstream s' has incomplete type and cannot be\n"
                             "a.cc:4:1: error: variable 'std::ifstream in' has initializer but incomplete type\n"
                             "a.cc:5:1: error: 'degrees' was not declared in this scope\n"
                             "a.cc:6:1: error: 'OFbkImage' has not been declared\n"),
              ElementsAre("iomanip", "algorithm", "sstream", "fstream", "OPENR/OUnits.h", "OPENR/OFbkImage.h"));
  EXPECT_THAT(missingHeaders("a.cc:1:1: error: must '#include <typeinfo>' before using 'typeid'\n"),
              ElementsAre("typeinfo"));
}

TEST(SourceCure, NamesOfTheStandardLibraryWithoutItsNamespaceAreFound) {
  const auto one = ElementsAre("btr_standard_names.h");
  EXPECT_THAT(missingHeaders("a.cc:1:9: error: 'map' does not name a type\n"), one);
  EXPECT_THAT(missingHeaders("a.cc:2:1: error: 'string' was not declared in this scope; did you mean 'std::string'?\n"),
              one);
  EXPECT_THAT(missingHeaders("c++/bits/stringfwd.h:77:33: note: 'std::string' declared here\n"), one);
  EXPECT_THAT(missingHeaders("a.cc:1:9: error: 'Mine' does not name a type\n"), ElementsAre());
}

TEST(RobotLongs, AreIntsInTheProgramsOwnFiles) {
  const std::string marker = "# 1 \"a.cc\"\n";
  const auto narrow = [&](const std::string& text) {
    return withRobotLongs(marker + text, "/kit").substr(marker.size());
  };
  EXPECT_EQ(narrow("unsigned long a; const long int b[2];"), "unsigned int  a; const      int b[2];");
  EXPECT_EQ(narrow("f((long)p, sizeof(long))"), "f((int )p, sizeof(int ))");
  EXPECT_EQ(narrow("1L 12ul 0xfFUL 010lu"), "1  12u  0xfFU  010u ");
  for (const char* same : {"long long a; unsigned long long int b; long double c;", "1.0L 3LL 1e3L .5L 1ULL 12 0x1F",
                           "char* a = \"long\"; int longer, along;", "x.long_ = y1L;"})
    EXPECT_EQ(narrow(same), same);
}

TEST(RobotLongs, StayInHeadersOfTheSystemAndOfTheKit) {
  const std::string foreign =
      "# 1 \"/usr/include/a.h\" 1 3 4\nlong a;\n# 1 \"/kit/b.h\" 1\nlong b;\n# 1 \"<built-in>\"\nlong c;\n";
  EXPECT_EQ(withRobotLongs(foreign, "/kit"), foreign);
  EXPECT_EQ(withRobotLongs(foreign + "# 7 \"a.cc\" 2\nlong d;\n", "/kit"), foreign + "# 7 \"a.cc\" 2\nint  d;\n");
  EXPECT_EQ(withRobotLongs("# 1 \"t.h\" 3\ntypedef unsigned long int ulong;\n# 1 \"a.cc\"\nulong x;\n", ""),
            "# 1 \"t.h\" 3\ntypedef unsigned      int ulong;\n# 1 \"a.cc\"\nulong x;\n");
}

TEST(Dialect, ALongHas32BitsInFilesStructuresAndArithmetic) {
  const std::string all = runStick(stickOf("longs"), 3).all();
  EXPECT_THAT(all, HasSubstr("sizes 4 4 8 12\n"));
  EXPECT_THAT(all, HasSubstr("limits 2147483647 -2147483648 4294967295\n"));
  EXPECT_THAT(all, HasSubstr("random 1337 1084\n"));  // products end after 32 bits
  EXPECT_THAT(all, HasSubstr("read abcd 7 -2 of 12\n"));
  EXPECT_THAT(all, HasSubstr("in C 4 -1\n"));
  EXPECT_THAT(all, HasSubstr("a time 1 1\n"));  // a long takes the time, as the robot's time_t was one
}

// Overloads for int and long are two with a long of 64 bits alone: so it has them in every source of that stick, and
// all of them mean the same by a structure.
TEST(Dialect, ALongIsAsLongInAllSourcesOfAStick) {
  const std::string stick = emptyFolder("widths_stick");
  const StickBuild build = buildOnto(stick, {programFolder("widths")});
  ASSERT_TRUE(build.complete());
  EXPECT_THAT(build.objects[0].said, HasSubstr("Overloads.cc: "));
  EXPECT_THAT(build.objects[0].said, HasSubstr("a long has 64 bits here in all sources of this stick"));
  const std::string all = runStick(stick, 3).all();
  EXPECT_THAT(all, HasSubstr("overloads int long"));
  EXPECT_THAT(all, HasSubstr("percept 5 100 -200 0.5\n"));
}

// What a program keeps out of a conversion or a root is not computed beside the rest, however it is optimised.
TEST(Dialect, WhatStandsBehindAQuestionIsNotComputedBeforeItIsAnswered) {
  const std::string all = runStick(stickOf("asked"), 3).all();
  EXPECT_THAT(all, HasSubstr("255 21 1000000 2.65 3.5\n"));
}

TEST(Dialect, NamesAreFoundWithoutTheirNamespaceAsBeforeTheStandard) {
  const std::string all = runStick(stickOf("plain"), 3).all();
  EXPECT_THAT(all, HasSubstr("kick  5;walk  3; most 5\n"));
  EXPECT_THAT(all, HasSubstr("and so on, 110 letters\n"));  // with a new and a delete of its own
  EXPECT_THAT(all, HasSubstr("same type 1\n"));
  EXPECT_THAT(all, HasSubstr("kept 11111\n"));
  EXPECT_THAT(all, HasSubstr("NECK 11\n"));  // of the robot's C library
  EXPECT_THAT(all, HasSubstr("page 0 4096 1\n"));
}

TEST(Dialect, HeadersOfTheRobotThatASourceLeavesOutAreFound) {
  const std::string all = runStick(stickOf("omitted"), 3).all();
  EXPECT_THAT(all, HasSubstr("90.0 degrees, 3141592 microradians\n"));
  EXPECT_THAT(all, HasSubstr("same 0 0, other 1\n"));
  EXPECT_THAT(all, HasSubstr("dif 9 power 0\n"));
  EXPECT_THAT(all, HasSubstr("00036 2 1\n"));
}

TEST(Dialect, SourcesOf2003RunAsTheyAre) {
  const std::string all = runStick(stickOf("dialect"), 3).all();
  EXPECT_THAT(all, HasSubstr("old c: literal 0\n"));        // K&R C that includes Types.h
  EXPECT_THAT(all, HasSubstr("one two three ff    3\n"));   // a global `messages`, with <iostream.h>
  EXPECT_THAT(all, HasSubstr("stl x 9 12 1 3.5 3 1 3\n"));  // templates without typename and this->
  EXPECT_THAT(all, HasSubstr("3 44 1 0.125000 7\n"));       // numbers that are cut
  EXPECT_THAT(all, HasSubstr("assign in if 3 5\n"));
  // In C, too, "%ld" writes what its variable has, and a long ends where the robot's does.
  EXPECT_THAT(all, HasSubstr("scanned 5: 4000000000 99 -5 2.5 x 3, 21 characters\n"));
  EXPECT_THAT(all, HasSubstr("none 0, longest 2147483647\n"));
}

TEST(Dialect, AStubByHandOfEarlierProgramsIsMadeByItsMacros) {
  const std::string all = runStick(stickOf("relay"), 3).all();
  EXPECT_THAT(all, HasSubstr("Ready ASSERT\nRelay: got hello from 1\nRelay: Ready ASSERT\nRelay: got hello from 1\n"));
  EXPECT_THAT(all, HasSubstr("Ready DEASSERT\n"));  // at its end
}

TEST(Dialect, ExtensionsSizesAndNumbersAsTheRobotsCompilerHadThem) {
  const std::string all = runStick(stickOf("ancient"), 3).all();
  EXPECT_THAT(all, HasSubstr("in Extensions: found\n"));
  EXPECT_THAT(all, HasSubstr("casts 2 2 ffffffff\n"));
  EXPECT_THAT(all, HasSubstr("clipped 5 0 9, most 6\n"));
  EXPECT_THAT(all, HasSubstr("mixed 50 1\n"));
  EXPECT_THAT(all, HasSubstr("sizes 1024 4000 64\n"));
  // Nothing beside a longword is written by "%ld", whatever its file includes.
  EXPECT_THAT(all, HasSubstr("read 4 alpha 4000000000 deadbeef 17 7\n"));
  EXPECT_THAT(all, HasSubstr("read 2 65535 9 -70000 5\n"));
  EXPECT_THAT(all, HasSubstr("read 5 1 1 1 15\n"));
  EXPECT_THAT(all, HasSubstr("read 3 12 13 3 x\n"));
  EXPECT_THAT(all, HasSubstr("parts 6 42\n"));  // from folders below the object's, without a Makefile
}

TEST(Dialect, IdiomsOfThatTimeMeanWhatTheyMeant) {
  const std::string all = runStick(stickOf("idiom"), 3).all();
  EXPECT_THAT(all, HasSubstr("42 1 5 3 0 5 9 34 7\n"));  // friends, members of templates, packed bytes
  EXPECT_THAT(all, HasSubstr("255 8 49 void Idiom::go()\n"));
  EXPECT_THAT(all, HasSubstr("i 2 ci 2 45\n"));  // a loop's variable behind the loop
  // A long is as long as an int.
  EXPECT_THAT(all, HasSubstr("-5|  -5|-6  |-5|fffffff0 4294967280 1.500000 1099511627776 -5%\n"));
  EXPECT_THAT(all, HasSubstr("long -5 -5 end\n"));
  EXPECT_THAT(all, HasSubstr("undef\n"));
  EXPECT_THAT(all, HasSubstr("machine 77, memory 1 1\n"));  // the branch for this processor, where there is one
}

TEST(Dialect, ATeamsProgramIsBuiltByItsMakefilesAndMoves) {
  const std::string stick = stickOf("league");
  EXPECT_TRUE(std::filesystem::exists(stick + "/OPEN-R/SYSTEM/CONF/WLANCONF.TXT"));
  const StickRun run = runStick(stick, 125);
  EXPECT_THAT(run.all(), HasSubstr("Brain: loaded 1 speed 12.5\n"));
  EXPECT_THAT(run.all(), HasSubstr("Motion: connect 0 Brain.Orders.Order.S 1\n"));
  const auto pan = run.targets(robotDesign("ERS-7"), "HEAD_PAN");
  ASSERT_FALSE(pan.empty());
  EXPECT_EQ(*std::max_element(pan.begin(), pan.end()), 300000);
}

TEST(Dialect, AMakefileThatBuildsTheJpegLibraryFirstIsGivenThisComputers) {
  if (!std::filesystem::exists("/usr/include/jpeglib.h")) GTEST_SKIP() << "there is no JPEG library";
  const CameraImage grey{416, 320, std::vector<std::uint8_t>(std::size_t{3} * 416 * 320, 128)};
  const std::string stick = stickOf("web");
  const StickRun run = runStick(stick, 12, [&](int, TrivialRobot& robot) { robot.image = grey; });
  EXPECT_THAT(run.all(), HasSubstr("jpeg 1 ffd8\n"));  // by a jpeg_mem_dest() of its own
  EXPECT_TRUE(std::filesystem::exists(stick + "/P.JPG"));
}

TEST(Dialect, CalendarTimesAndFoldersInOrder) {
  const std::string all = runStick(stickOf("almanac"), 10).all();
  EXPECT_THAT(all, HasSubstr("today 1/1/2004 00:00:00, weekday 4, kept 4\n"));
  EXPECT_THAT(all, HasSubstr("Tokyo 9:00, 9 hours, same 1\n"));
  EXPECT_THAT(all, HasSubstr("later 1, 30 February 4\n"));
  EXPECT_THAT(all, HasSubstr("Almanac: 2000-01-01 00:00:00\n"));
  EXPECT_THAT(all, HasSubstr("in 2.500 s\n"));
  EXPECT_THAT(all, HasSubstr("waited 40000 us\n"));
  EXPECT_THAT(all, HasSubstr("/MS: APE.TXT MOUSE.TXT OPEN-R ZEBRA.TXT, first again APE.TXT\n"));
  EXPECT_THAT(all, HasSubstr("/MS/OPEN-R/MW: . .. CONF DATA OBJS, first again .\n"));
  EXPECT_THAT(all, HasSubstr("stands in a folder 0\n"));
}

}  // namespace
}  // namespace btr::openr
