#include "core/run/reality/stored_recordings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using ::testing::HasSubstr;

class StoredRecordings : public testing::Test {
 protected:
  StoredRecordings() : database_(Database::open(folder_.file("a.db"), Database::Mode::create)) {
    experiment_ = database_.addExperiment({0, "leg", "{}", "", ""});
    csv_ = folder_.write("swing.csv", "t_ms,q\n0,10\n10,20\n20,25\n");
    folder_.write(
        "swing.mapping.json",
        R"({"time_s": {"column": "t_ms", "scale": 0.001}, "leg.knee.position_rad": {"column": "q", "scale": 0.1}})");
  }
  TemporaryFolder folder_;
  Database database_;
  Id experiment_ = 0;
  std::string csv_;
};

TEST_F(StoredRecordings, KeepBytesMappingAndHash) {
  const StoredRecording stored = importRecording(database_, experiment_, csv_);
  EXPECT_TRUE(stored.isNew);
  EXPECT_EQ(stored.rows, 3u);
  const RecordingRecord record = database_.recording(stored.id);
  EXPECT_EQ(record.csv, readFile(csv_));
  EXPECT_EQ(record.sha256, sha256(readFile(csv_)));
  EXPECT_EQ(record.mappingJson, readFile(folder_.file("swing.mapping.json")));
  EXPECT_EQ(record.name, "swing.csv");
}

TEST_F(StoredRecordings, TheSameFileIsKeptOnce) {
  const Id first = importRecording(database_, experiment_, csv_).id;
  const StoredRecording again = importRecording(database_, experiment_, csv_);
  EXPECT_FALSE(again.isNew);
  EXPECT_EQ(again.id, first);
  EXPECT_EQ(database_.recordings(experiment_).size(), 1u);
}

TEST_F(StoredRecordings, ComeBackAsTheFilesThatAnAnalysisReads) {
  const Id id = importRecording(database_, experiment_, csv_).id;
  const std::string path = exportRecording(database_, id, folder_.file("out"));
  EXPECT_EQ(readFile(path), readFile(csv_));
  const Recording read = loadRecording(path);
  EXPECT_EQ(read.columns[0], (std::vector<double>{0, 0.01, 0.02}));
  EXPECT_EQ(read.columns[1], (std::vector<double>{1, 2, 2.5}));
  EXPECT_EQ(read.sha256, database_.recording(id).sha256);
  // Twice is fine, another file of that name is not overwritten.
  EXPECT_EQ(exportRecording(database_, id, folder_.file("out")), path);
  folder_.write("out/swing.csv", "mine");
  EXPECT_THROW(exportRecording(database_, id, folder_.file("out")), InputError);
  EXPECT_EQ(readFile(path), "mine");
}

TEST_F(StoredRecordings, DamagedOnesDoNotGetIn) {
  folder_.write("swing.csv", "t_ms,q\n0,10\n0,20\n");
  try {
    importRecording(database_, experiment_, csv_);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("line 3, column 2 (leg.knee.position_rad)"));
  }
  EXPECT_TRUE(database_.recordings(experiment_).empty());
}

TEST_F(StoredRecordings, ANameStaysWithinTheFolder) {
  RecordingRecord record;
  record.experiment = experiment_;
  record.name = "../../escape.csv";
  record.csv = "time_s\n0\n";
  const std::string path = exportRecording(database_, database_.addRecording(record), folder_.file("out"));
  EXPECT_EQ(path, folder_.file("out/escape.csv"));
}

}  // namespace
}  // namespace btr
