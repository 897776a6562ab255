#include "core/run/reality/measured_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/spec/error.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using testing::HasSubstr;

const std::vector<MeasurementTask> tasks{{1, 1, 7, 1, 0, 1, false}, {1, 1, 12, 2, 0, 1, false}};

std::vector<MeasurementRecord> read(const std::string& text) {
  std::istringstream stream(text);
  return readMeasuredCsv(stream, "measured.csv", &tasks);
}

std::string refusalOf(const std::string& text) {
  return test::refusal([&] { read(text); });
}

TEST(MeasuredImport, ReadsValuesNotesAndVoidsInAnyOrderOfColumns) {
  const auto all =
      read("void, value ,individual,note\n,0.25,7,\"fast, straight\"\nyes,-1e-3,12,fell\n1,,7,\n0,+2,7,\n");
  ASSERT_EQ(4u, all.size());
  EXPECT_EQ(7, all[0].individual);
  EXPECT_EQ(0.25, all[0].value);
  EXPECT_EQ("fast, straight", all[0].note);
  EXPECT_FALSE(all[0].isVoid);
  EXPECT_EQ(12, all[1].individual);
  EXPECT_EQ(-1e-3, all[1].value);
  EXPECT_TRUE(all[1].isVoid);
  EXPECT_TRUE(all[2].isVoid);
  EXPECT_EQ(2.0, all[3].value);
  EXPECT_EQ("person", all[3].source);
}

TEST(MeasuredImport, TakesTablesAsSpreadsheetsWriteThem) {
  const auto all =
      read("\xEF\xBB\xBFindividual,value,note,void\r\n\r\n7,0.5,\"two\nlines\",\r\n,,,\r\n12,0.75,,\r\n , ,,\r\n");
  ASSERT_EQ(2u, all.size());
  EXPECT_EQ("two\nlines", all[0].note);
  EXPECT_EQ(0.75, all[1].value);
}

TEST(MeasuredImport, TakesTablesWithSemicolonsAndDecimalCommas) {
  const auto all = read("\r\nindividual;value;note;void\r\n7;0,5;53;\r\n12;0.75;\"a; b\";\r\n7;1;;\r\n;;;\r\n");
  ASSERT_EQ(3u, all.size());
  EXPECT_EQ(0.5, all[0].value);
  EXPECT_EQ("53", all[0].note);
  EXPECT_EQ(0.75, all[1].value);
  EXPECT_EQ("a; b", all[1].note);
  EXPECT_EQ(1, all[2].value);
  for (const char* value : {"1.234,5", "1,234,5", "1,234.5", "0,5 m"})
    EXPECT_EQ("measured.csv line 2, column 2: the value \"" + std::string(value) + "\" is not allowed; a finite number",
              refusalOf("individual;value\n7;" + std::string(value) + "\n"));
  EXPECT_THAT(refusalOf("individual;value,note\n7;1;\n"), HasSubstr("or by semicolons"));
}

TEST(MeasuredImport, NamesLineAndColumnOfTheFirstWrongCell) {
  EXPECT_EQ("measured.csv line 3, column 2: the value \"half\" is not allowed; a finite number with a decimal point",
            refusalOf("individual,value\n7,0.5\n12,half\n"));
  EXPECT_EQ("measured.csv line 2, column 2: an empty value is not allowed; a finite number with a decimal point",
            refusalOf("individual,value\n7,\n"));
  for (const char* value : {"\"0,5\"", "nan", "inf", "1e999", "0.5 m", "0x1p3", "--1"})
    EXPECT_THAT(refusalOf("individual,value\n7," + std::string(value) + "\n"), HasSubstr("line 2, column 2: the value"))
        << value;
  for (const char* individual : {"", "seven", "-7", "0", "7.0", "99999999999999999999"})
    EXPECT_THAT(
        refusalOf("value,individual\n1," + std::string(individual) + "\n"),
        HasSubstr("line 2, column 2: the individual \"" + std::string(individual) + "\" is not allowed; the number"));
  EXPECT_EQ("measured.csv line 2, column 1: individual 8 is not allowed; this run asks for 7, 12",
            refusalOf("individual,value\n8,1\n"));
  EXPECT_THAT(refusalOf("individual,value,void\n7,1,maybe\n"),
              HasSubstr("line 2, column 3: \"maybe\" is not allowed; 1, yes"));
  EXPECT_EQ("measured.csv line 3: a row of 3 cells is not allowed; 2 as in the header",
            refusalOf("individual,value\n7,1\n7,1,2\n"));
  EXPECT_THAT(refusalOf("individual,value\n7\n"), HasSubstr("line 2: a row of 1 cells"));
  EXPECT_THAT(refusalOf("individual,value\n7,\"1\n"), HasSubstr("line 2, column 2: the quote"));
}

TEST(MeasuredImport, ConvertsAUnitInTheHeadingOrRefusesIt) {
  const auto in = [](const std::string& heading, const std::string& unit, double value) {
    std::istringstream stream("individual," + heading + "\n7," + std::to_string(value) + "\n");
    return readMeasuredCsv(stream, "measured.csv", &tasks, unit).front().value;
  };
  for (const char* heading : {"value [cm]", "value (cm)", "value_cm", "value[cm]"}) {
    EXPECT_EQ(0.41, in(heading, "m", 41)) << heading;
    EXPECT_EQ(41, in(heading, "cm", 41)) << heading;
  }
  EXPECT_EQ(0.41, in("value (mm)", "m", 410));
  EXPECT_EQ(20, in("value_m_s", "cm/s", 0.2));
  EXPECT_DOUBLE_EQ(3.14159265358979312 / 2, in("value [deg/s]", "rad/s", 90));
  EXPECT_EQ(41, in("value", "m", 41));
  EXPECT_EQ("measured.csv line 1, column 2: values in the unit \"ft\" is not allowed; m, cm, mm",
            test::refusal([&] { in("value [ft]", "m", 1); }));
  EXPECT_THAT(test::refusal([&] { in("value_cm", "", 1); }), HasSubstr("without a unit"));
  EXPECT_THAT(test::refusal([&] { in("value [kg]", "cm/s", 1); }), HasSubstr("m/s, cm/s, mm/s"));
}

TEST(MeasuredImport, TellsTheLineOfEachValue) {
  std::istringstream stream("individual,value,note\n7,1,\"two\nlines\"\n12,2,\n");
  std::vector<std::string> places;
  readMeasuredCsv(stream, "measured.csv", &tasks, "m", &places);
  EXPECT_EQ((std::vector<std::string>{"line 2", "line 4"}), places);
}

TEST(MeasuredImport, ChecksTheHeader) {
  EXPECT_EQ(
      "measured.csv line 1, column 3: the column \"colour\" is not allowed; columns are "
      "individual,value[,note][,void], "
      "separated by commas, or by semicolons where decimals have a comma",
      refusalOf("individual,value,colour\n"));
  EXPECT_THAT(refusalOf("individual|value\n7|1\n"), HasSubstr("the column \"individual|value\" is not allowed"));
  EXPECT_THAT(refusalOf("individual,value,value\n"), HasSubstr("column 3: a second column \"value\""));
  EXPECT_THAT(refusalOf("individual,note\n"), HasSubstr("line 1: a table without the column \"value\""));
  EXPECT_THAT(refusalOf(""), HasSubstr("measured.csv: is empty"));
  EXPECT_THAT(refusalOf("individual,value\n\n"), HasSubstr("measured.csv: holds no values"));
}

TEST(MeasuredImport, ADecimalCommaIsNotReadAsAValueAndItsNote) {
  EXPECT_THAT(refusalOf("individual,value,note\n7,0,53\n"),
              HasSubstr("line 2, column 2: \"0,53\" is not allowed; a value with a decimal point"));
  EXPECT_THAT(refusalOf("individual,value,note\n7,-1,5\n"), HasSubstr("\"-1,5\""));
  EXPECT_EQ("2nd", read("individual,value,note\n7,1,2nd\n").at(0).note);
  EXPECT_EQ("2", read("individual,note,value\n7,2,1\n").at(0).note);
  EXPECT_EQ("2", read("individual,value,note\n7,1.0,2\n").at(0).note);
}

TEST(MeasuredImport, NamesAFileThatCannotBeRead) {
  const auto folder = std::filesystem::temp_directory_path();
  for (const std::string& path : {(folder / "no_such_measured.csv").string(), folder.string()}) {
    try {
      readMeasuredCsv(path);
      FAIL() << "accepted " << path;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path + ": "));
    }
  }
}

}  // namespace
}  // namespace btr
