// What a recording's times and leaps say of the file, before physics is asked.
#include "core/gap/recordings/doctor/time_doctor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/leaps.h"
#include "core/gap/recordings/doctor/retime.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using What = Binding::Measured::What;

double strolling(double t) { return 0.6 * std::sin(3 * t) + 0.2 * std::sin(7.1 * t); }
double strollingRate(double t) { return 1.8 * std::cos(3 * t) + 1.42 * std::cos(7.1 * t); }

/// A joint's position and velocity, sampled every `period_s`, 6 s long.
struct Sampled {
  Recording trial;
  Binding binding;

  explicit Sampled(double period_s, double jitter_s = 0) {
    Random random(8);
    trial.channels = {"time_s", "leg.knee.position_rad", "leg.knee.velocity_rad_s"};
    trial.columns.resize(3);
    for (double t = 0; t < 6; t += period_s) {
      trial.columns[0].push_back(t + jitter_s * random.uniform());
      trial.columns[1].push_back(strolling(t) + 0.0005 * random.normal());
      trial.columns[2].push_back(strollingRate(t) + 0.02 * random.normal());
    }
    binding.measured = {{What::position, 0, 0, 1}, {What::rate, 0, 0, 2}};
  }
  void scale(std::size_t column, double factor) {
    for (double& value : trial.columns[column]) value *= factor;
  }
  std::vector<std::string> times() const {
    std::vector<Finding> findings;
    lookAtTime(trial, binding, findings);
    return texts(findings);
  }
  std::vector<std::string> leaps() const {
    std::vector<Finding> findings;
    lookForLeaps(trial, binding, findings);
    return texts(findings);
  }

 private:
  static std::vector<std::string> texts(const std::vector<Finding>& findings) {
    std::vector<std::string> all;
    for (const Finding& finding : findings) all.push_back(finding.text);
    return all;
  }
};

TEST(TimeDoctor, SaysNothingOfTheRatesThatLogsHave) {
  for (const double period : {0.0001, 0.001, 0.004, 0.02, 0.1, 0.5}) {
    EXPECT_THAT(Sampled(period).times(), IsEmpty()) << period;
    EXPECT_THAT(Sampled(period).leaps(), IsEmpty()) << period;
  }
}

TEST(TimeDoctor, FindsTimesThatAreAThousandTimesTooLong) {
  struct Case {
    double period_s, factor;
    const char *name, *scale;
  };
  for (const Case& each : {Case{0.002, 1e3, "milliseconds", "0.001"},
                           {0.01, 1e3, "milliseconds", "0.001"},
                           {0.02, 1e3, "milliseconds", "0.001"},
                           {0.005, 1e6, "microseconds", "1e-06"},
                           {0.01, 1e9, "nanoseconds", "1e-09"}}) {
    Sampled sampled(each.period_s);
    sampled.scale(0, each.factor);
    EXPECT_THAT(sampled.times(), ElementsAre(AllOf(HasSubstr(each.name), HasSubstr(each.scale)))) << each.period_s;
  }
  Sampled counted(0.01);
  for (std::size_t i = 0; i < counted.trial.rows(); ++i) counted.trial.columns[0][i] = static_cast<double>(i);
  EXPECT_THAT(counted.times(), ElementsAre(HasSubstr("the number of the sample")));
}

TEST(TimeDoctor, FindsTimesThatAreAThousandTimesTooShort) {
  for (const double period : {0.001, 0.005, 0.02, 0.04})
    for (const double factor : {1e3, 1e6}) {
      Sampled sampled(period);
      sampled.scale(0, 1 / factor);
      const auto found = sampled.times();
      EXPECT_THAT(found, ElementsAre(AllOf(HasSubstr("too fast for a robot's log"),
                                           HasSubstr(factor == 1e3 ? "1000 times too short" : "1000000 times"),
                                           HasSubstr("multiply the \"scale\" of time_s"))))
          << period << " " << factor;
    }
}

TEST(TimeDoctor, FindsStampsThatJitterAndTheirSize) {
  const auto found = Sampled(0.005, 0.003).times();
  // The standard deviation of an even spread over 3 ms.
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], AllOf(HasSubstr("the stamps jitter by 0.00"), HasSubstr("\"retime\": \"even\"")));
  EXPECT_NEAR(std::stod(found[0].substr(found[0].find("by ") + 3)), 0.003 / std::sqrt(12.0), 0.0001);
  // Uneven samples whose stamps are right.
  Sampled uneven(0.005, 0.003);
  for (std::size_t i = 0; i < uneven.trial.rows(); ++i) {
    uneven.trial.columns[1][i] = strolling(uneven.trial.columns[0][i]);
    uneven.trial.columns[2][i] = strollingRate(uneven.trial.columns[0][i]);
  }
  EXPECT_THAT(uneven.times(), IsEmpty());
}

TEST(TimeDoctor, ComparesAVelocityWithTheSlopeOfItsPosition) {
  Sampled degrees(0.005);
  degrees.scale(2, 180 / M_PI);
  EXPECT_THAT(degrees.times(), ElementsAre(AllOf(HasSubstr("in degrees per second"), HasSubstr("by 0.0174533"))));
  Sampled turned(0.005);
  turned.scale(2, -1);
  EXPECT_THAT(turned.times(), ElementsAre(HasSubstr("a sign is turned")));
  Sampled revolutions(0.005);
  revolutions.scale(2, 30 / M_PI);
  EXPECT_THAT(revolutions.times(), ElementsAre(HasSubstr("revolutions per minute")));
  // Filtered, and half as large: no unit.
  Sampled half(0.005);
  half.scale(2, 0.5);
  EXPECT_THAT(half.times(), IsEmpty());
}

TEST(Leaps, AreNoMotion) {
  Sampled odd(0.005);
  for (double& q : odd.trial.columns[1]) q = q - 0.77 * std::floor(q / 0.77);
  EXPECT_THAT(odd.leaps(), ElementsAre(AllOf(HasSubstr("leg.knee.position_rad leaps by 0.7"), HasSubstr("times more"),
                                             HasSubstr("\"wrap\""), HasSubstr("\"sign_bit\""))));
  Sampled spike(0.005);
  spike.trial.columns[1][300] += 40;
  spike.trial.columns[1][700] -= 3;
  EXPECT_THAT(spike.leaps(),
              ElementsAre(AllOf(HasSubstr("2 single samples stand out by up to 40 rad, the first at 1.5 s"),
                                HasSubstr("leave these cells empty"))));
  // One beside another, and one that lasts for two rows.
  spike.trial.columns[1][301] -= 2;
  spike.trial.columns[1][701] -= 3;
  EXPECT_THAT(spike.leaps(), ElementsAre(HasSubstr("4 single samples stand out by up to 42 rad, the first at 1.5 s")));
  // The size that is told is that of the leap whose time is told.
  Sampled twice(0.005);
  for (std::size_t row = 200; row < twice.trial.rows(); ++row) twice.trial.columns[1][row] += row < 600 ? 2 : 7;
  EXPECT_THAT(twice.leaps(), ElementsAre(AllOf(HasSubstr("leaps by 2 rad"), HasSubstr("at 1 s"),
                                               HasSubstr("1 times more (by up to 4.99 rad)"))));
  // A pause in which the joint was moved.
  Sampled pause(0.005);
  for (auto& column : pause.trial.columns) column.erase(column.begin() + 100, column.begin() + 400);
  for (std::size_t row = 100; row < pause.trial.rows(); ++row) pause.trial.columns[1][row] += 3;
  EXPECT_THAT(pause.leaps(), IsEmpty());
}

// A camera that misses a picture now and then: stamps of 120 a second to a tenth of a millisecond.
TEST(StampsThatJitter, AreNotThoseBehindLostRows) {
  Recording trial;
  trial.channels = {"time_s"};
  trial.columns.resize(1);
  for (int i = 0; i < 100; ++i)
    if (i % 16 != 6) trial.columns[0].push_back(std::round(1e4 * i / 120) / 1e4);
  const StampJitter jitter = stampJitter(trial);
  EXPECT_NEAR(jitter.period_s, 1.0 / 120, 1e-4);
  EXPECT_LT(jitter.size_s, 0.01 / 120) << "rounding to 0.1 ms is 0.03 ms, of 8.3";
}

}  // namespace
}  // namespace btr
