// The doctor comes before physics is blamed.
#include "core/gap/search/trials/consultation.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/report/report_html.h"
#include "core/gap/search/gap_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/gap/recorded_hinge.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Trials of a healthy rig whose positions were written in another way.
GapProblem written(double scale, double offset = 0) {
  GapProblem problem = recordedInItsSteps();
  for (Recording& recording : problem.recordings)
    for (double& value : recording.columns[2]) value = scale * value + offset;
  return problem;
}

TEST(Consultation, LetsHealthyRecordingsPassWithoutAWord) {
  const Consultation found = consult(recordedInItsSteps(), library(), false);
  EXPECT_EQ(found.caveat, "");
}

TEST(Consultation, RefusesDegreesAndTurnedSignsWithWhatToChangeInTheMapping) {
  const auto refusal = [](const GapProblem& problem) {
    return test::refusal([&] { consult(problem, library(), false); });
  };
  EXPECT_THAT(refusal(written(180 / M_PI)),
              AllOf(StartsWith("trial_0.csv: rig.hinge.position_rad"), HasSubstr("is in degrees, not radians"),
                    HasSubstr("by 0.0174533"), HasSubstr("--as-recorded")));
  EXPECT_THAT(refusal(written(-1)), HasSubstr("a sign is turned"));
  GapProblem heldOut = recordedInItsSteps();
  heldOut.heldOut = written(-1).recordings;
  for (Recording& recording : heldOut.heldOut) recording.mapping = "turned.mapping.json";
  EXPECT_THAT(refusal(heldOut), HasSubstr("a sign is turned"));
}

// Driven beyond its resonance a joint moves against its command; a mapping that turns a sign turns it in every
// recording.
TEST(Consultation, DoesNotRefuseASignThatOthersReadInTheSameWayDoNotTurn) {
  GapProblem problem = recordedInItsSteps();
  ASSERT_GT(problem.recordings.size(), 1u);
  Recording& odd = problem.recordings[1];
  for (double& value : odd.columns[2]) value = -value;
  EXPECT_THAT(consult(problem, library(), false).caveat,
              AllOf(HasSubstr("trial_1.csv"), HasSubstr("a sign is turned")));
  odd.mapping = "of its own.mapping.json";
  EXPECT_THAT(test::refusal([&] { consult(problem, library(), false); }),
              AllOf(StartsWith("trial_1.csv"), HasSubstr("a sign is turned")));
}

TEST(Consultation, LeadsTheSentenceWhereItIsOverruled) {
  const Consultation found = consult(written(-1), library(), true);
  EXPECT_THAT(found.caveat, AllOf(StartsWith("The recordings themselves come first: trial_0.csv"),
                                  HasSubstr("a sign is turned"), HasSubstr("need not be physics")));
  ASSERT_FALSE(found.notes.empty());
  EXPECT_THAT(found.notes[0], HasSubstr("a sign is turned"));
}

TEST(Consultation, SaysWhatMayBePhysicsWithoutRefusingIt) {
  EXPECT_THAT(consult(written(1, 0.5), library(), false).caveat, HasSubstr("an offset of the encoder"));
}

TEST(Consultation, PutsManyDroppedSamplesIntoTheSentence) {
  GapProblem problem = recordedInItsSteps();
  const auto drop = [&](std::size_t every) {
    Recording& recording = problem.recordings[0];
    for (auto& column : recording.columns) {
      std::vector<double> kept;
      for (std::size_t i = 0; i < column.size(); ++i)
        if (i % every != 5) kept.push_back(column[i]);
      column = kept;
    }
  };
  drop(100);
  EXPECT_EQ(consult(problem, library(), false).caveat, "");
  EXPECT_THAT(consult(problem, library(), false).notes, testing::Contains(HasSubstr("samples missing")));
  drop(12);
  EXPECT_THAT(consult(problem, library(), false).caveat, HasSubstr("samples missing"));
}

TEST(Consultation, LeadsTheReportOfAnAnalysisThatGoesOn) {
  AnalysisOptions options;
  options.asRecorded = true;
  options.effects = {"coulomb_friction"};
  options.designNext = false;
  const GapReport report = analyse(written(-1), library(), options);
  EXPECT_THAT(report.sentence, StartsWith("The recordings themselves come first: "));
  EXPECT_THAT(report.notes[0], HasSubstr("a sign is turned"));
  EXPECT_THAT(toHtml(report), HasSubstr("The recordings themselves come first: "));
}

}  // namespace
}  // namespace btr
