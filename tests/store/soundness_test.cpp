// What opening reads of a large file.
#include "core/store/soundness.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/SQLiteCpp.h>

#include <fstream>

#include "core/spec/random.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::streamoff page = 4096;

class Soundness : public StoreTest {
 protected:
  // A run of 40 generations, and traces of its first individuals.
  void fill(int traces, std::size_t trace_bytes) {
    Database database = create();
    const Id run = startRun(database);
    for (int number = 1; number <= 40; ++number) {
      GenerationRecord generation = generationOf(run, number);
      database.addGeneration(generation);
    }
    Random random(1);
    std::string packed(trace_bytes, ' ');
    for (char& byte : packed) byte = static_cast<char>(random.below(256));
    for (Id individual = 1; individual <= traces; ++individual) database.setTrace(individual, packed, "hash");
    database.moveLogIntoFile();
  }
  std::vector<std::int64_t> pagesOf(const std::string& name, const std::string& where = "1") const {
    const SQLite::Database raw(file());
    SQLite::Statement row(raw, "SELECT pageno FROM dbstat WHERE name = ? AND " + where + " ORDER BY pageno");
    row.bind(1, name);
    std::vector<std::int64_t> pages;
    while (row.executeStep()) pages.push_back(row.getColumn(0).getInt64());
    return pages;
  }
  void damage(std::int64_t number) const {
    std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp((number - 1) * page);
    Random random(static_cast<std::uint64_t>(number));
    for (int k = 0; k < page; ++k) stream.put(static_cast<char>(random.below(256)));
  }
  std::string finding() const {
    try {
      SQLite::Database raw(file(), SQLite::OPEN_READWRITE);
      raw.exec("PRAGMA cell_size_check = ON");
      return whyNotSound(raw, 0);
    } catch (const SQLite::Exception& error) {
      return error.what();
    }
  }
};

TEST_F(Soundness, NothingSpeaksAgainstASoundFileOfAnySize) {
  EXPECT_EQ("", (create(), finding()));
  fill(20, 10'000);
  EXPECT_EQ("", finding());
}

TEST_F(Soundness, EveryPageOfTheTablesThatSayWhatThereIsAreRead) {
  fill(0, 0);
  const std::string sound = pathOf("sound.db");
  std::filesystem::copy_file(file(), sound);
  for (const char* table :
       {"sqlite_schema", "experiment", "run", "run_state", "generation", "simulator", "measurement"})
    for (const std::int64_t number : pagesOf(table)) {
      if (number == 1) continue;
      damage(number);
      EXPECT_NE("", finding()) << table << ", page " << number;
      std::filesystem::copy_file(sound, file(), std::filesystem::copy_options::overwrite_existing);
    }
}

TEST_F(Soundness, ALeadingPageOfIndividualsOrOfTheirIndexIsMissed) {
  fill(0, 0);
  const std::string sound = pathOf("sound.db");
  std::filesystem::copy_file(file(), sound);
  for (const char* name : {"individual", "sqlite_autoindex_individual_1"})
    for (const std::int64_t number : pagesOf(name, "pagetype = 'internal'")) {
      damage(number);
      EXPECT_NE("", finding()) << name << ", page " << number;
      std::filesystem::copy_file(sound, file(), std::filesystem::copy_options::overwrite_existing);
    }
}

TEST_F(Soundness, ATruncatedLargeFileIsRefused) {
  fill(400, 100'000);
  std::filesystem::resize_file(file(), std::filesystem::file_size(file()) - 10 * page);
  EXPECT_THAT(refusal([&] { Database::open(file(), Database::Mode::readOnly); }),
              StartsWith(file() + ": is damaged ("));
}

TEST_F(Soundness, WhatOpeningDoesNotReadOfALargeFileShowsWhenItIsRead) {
  fill(400, 100'000);
  ASSERT_GT(std::filesystem::file_size(file()), readWhole_bytes);
  // The second individual's: opening reads the first of a part.
  const std::vector<std::int64_t> pages = pagesOf("trace", "path LIKE '/000/001+%'");
  ASSERT_GT(pages.size(), 2u);
  damage(pages[pages.size() / 2]);
  const Database database = Database::open(file(), Database::Mode::readOnly);
  EXPECT_EQ(1200u, database.individuals(1).size());
  EXPECT_THAT(refusal([&] { database.trace(2); }), HasSubstr("is damaged"));
  EXPECT_FALSE(database.findings().empty());
}

}  // namespace
}  // namespace btr
