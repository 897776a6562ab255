// Counters that begin again, and signs in a bit of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/counts.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Command and position of one joint [rad], and how they are written: counts of `count_rad`.
struct Servo {
  Recording trial;
  Mapping mapping;
  std::vector<double> position, command;
  double count_rad;

  Servo(double count, const std::function<double(double)>& motion, int rows = 800) : count_rad(count) {
    trial.channels = {"time_s", "leg.knee.command_rad", "leg.knee.position_rad"};
    trial.columns.resize(3);
    for (int i = 0; i < rows; ++i) {
      const double t = 0.005 * i;
      trial.columns[0].push_back(t);
      command.push_back(count * std::round(motion(t + 0.02) / count));
      position.push_back(count * std::round(motion(t) / count));
    }
    for (const char* name : {"leg.knee.command_rad", "leg.knee.position_rad"}) {
      MappedColumn column;
      column.channel = name;
      column.scale = count;
      mapping.columns.push_back(column);
    }
    write(
        1, [](double counts) { return counts; }, command);
    write(
        2, [](double counts) { return counts; }, position);
  }

  void write(std::size_t column, const std::function<double(double)>& written, const std::vector<double>& values) {
    trial.columns[column].clear();
    for (const double value : values)
      trial.columns[column].push_back(count_rad * written(std::round(value / count_rad)));
  }
  void writePosition(const std::function<double(double)>& written) { write(2, written, position); }
  void writeCommand(const std::function<double(double)>& written) { write(1, written, command); }

  double worst(std::size_t column, const std::vector<double>& values) const {
    double most = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      most = std::max(most, std::abs(trial.columns[column][i] - values[i]));
    return most;
  }
};

double swinging(double t) { return 0.8 * std::sin(3 * t + 0.3 * t * t); }
double spinning(double t) { return 0.3 + 5 * t + 0.5 * std::sin(4 * t); }

double wrapped(double counts, double period) { return counts - period * std::floor(counts / period); }
double signMagnitude(double counts, int bit) { return counts < 0 ? std::ldexp(1, bit) - counts : counts; }

TEST(Counts, ATurnsEndIsFollowed) {
  for (const double period : {1024.0, 4096.0, 65536.0, 3600.0, 1000.0})
    for (const auto& motion : {swinging, spinning}) {
      Servo servo(2 * M_PI / period, motion);
      servo.writePosition([&](double counts) { return wrapped(counts, period); });
      mendCounts(servo.trial, &servo.mapping);
      EXPECT_LT(servo.worst(2, servo.position), 1e-9) << period;
      EXPECT_THAT(servo.trial.notes, Contains(HasSubstr("leg.knee.position_rad: its numbers begin again every ")));
    }
}

TEST(Counts, APowerOfTwoIsFollowedThatIsNoTurn) {
  // 4096 counts a turn in a register of 16 bits; and 2¹⁶ of a slide of 1 µm.
  for (const double count : {2 * M_PI / 4096, 1e-6}) {
    Servo servo(count, [&](double t) { return count * 20000 * std::sin(2 * t); });
    servo.writePosition([](double counts) { return wrapped(counts, 65536); });
    servo.writeCommand([](double counts) { return wrapped(counts, 65536); });
    if (count == 1e-6) {
      servo.trial.channels = {"time_s", "leg.knee.command_m", "leg.knee.position_m"};
      servo.mapping.columns[0].channel = "leg.knee.command_m";
      servo.mapping.columns[1].channel = "leg.knee.position_m";
    }
    mendCounts(servo.trial, &servo.mapping);
    EXPECT_LT(servo.worst(2, servo.position), 1e-9);
    EXPECT_LT(servo.worst(1, servo.command), 1e-9);
  }
}

TEST(Counts, RadiansAndDegreesBeginAgainToo) {
  Servo radians(1, spinning);
  Random random(2);
  for (std::size_t i = 0; i < radians.position.size(); ++i) {
    radians.command[i] = spinning(0.005 * static_cast<double>(i) + 0.02);
    radians.position[i] = spinning(0.005 * static_cast<double>(i)) + 0.002 * random.normal();
    radians.trial.columns[1][i] = radians.command[i];
    radians.trial.columns[2][i] = std::remainder(radians.position[i], 2 * M_PI);
  }
  Recording degrees = radians.trial;
  mendCounts(radians.trial, nullptr);
  EXPECT_LT(radians.worst(2, radians.position), 1e-9);
  // The file has degrees, its mapping radians: all the same to the channel.
  Mapping mapping = radians.mapping;
  for (MappedColumn& column : mapping.columns) column.scale = M_PI / 180;
  std::swap(degrees, radians.trial);
  mendCounts(radians.trial, &mapping);
  EXPECT_LT(radians.worst(2, radians.position), 1e-9);
  EXPECT_THAT(radians.trial.notes, Contains(HasSubstr("begin again every 360")));
}

TEST(Counts, ASignInABitOfItsOwnIsRead) {
  for (const int bit : {10, 11, 15, 31}) {
    Servo servo(0.0015, swinging);
    servo.writePosition([&](double counts) { return signMagnitude(counts, bit); });
    mendCounts(servo.trial, &servo.mapping);
    EXPECT_LT(servo.worst(2, servo.position), 1e-9) << bit;
    EXPECT_THAT(servo.trial.notes, Contains(HasSubstr("leg.knee.position_rad: bit " + std::to_string(bit) +
                                                      " of its counts is the sign")));
  }
}

TEST(Counts, AVelocityMayHaveSuchASign) {
  Servo servo(0.024, [](double t) { return 4 * std::cos(2 * t); });
  servo.trial.channels[2] = "leg.knee.velocity_rad_s";
  servo.mapping.columns[1].channel = "leg.knee.velocity_rad_s";
  servo.writePosition([](double counts) { return signMagnitude(counts, 10); });
  mendCounts(servo.trial, &servo.mapping);
  EXPECT_LT(servo.worst(2, servo.position), 1e-9);
}

TEST(Counts, AreLeftAloneWhereNothingBeginsAgain) {
  const auto none = [](double t) { return std::fmod(t, 1.0) < 0.5 ? 0.0 : 1.0; };
  for (const double size : {M_PI, 2 * M_PI, 4095 * 2 * M_PI / 4096, 0.7}) {
    // Steps of a command, of any size, and a servo that follows them quickly.
    Servo servo(2 * M_PI / 4096, [&](double t) { return size * none(t); });
    double q = 0;
    for (std::size_t i = 0; i < servo.position.size(); ++i) {
      q += 0.2 * (servo.command[i] - q);
      servo.position[i] = servo.count_rad * std::round(q / servo.count_rad);
    }
    servo.writePosition([](double counts) { return counts; });
    const Recording before = servo.trial;
    mendCounts(servo.trial, &servo.mapping);
    EXPECT_EQ(servo.trial.columns, before.columns) << size;
    EXPECT_THAT(servo.trial.notes, IsEmpty()) << size;
  }
  Servo powers(1, [&](double t) { return 512 * none(t); });
  const auto asWritten = powers.trial.columns;
  mendCounts(powers.trial, &powers.mapping);
  EXPECT_EQ(powers.trial.columns, asWritten);
  // Steps between positive counts, some of them beyond a power of two.
  Servo counts(1, [&](double t) { return 100 + 900 * none(t) + 2 * std::sin(40 * t); });
  const auto before = counts.trial.columns;
  mendCounts(counts.trial, &counts.mapping);
  EXPECT_EQ(counts.trial.columns, before);
}

TEST(Counts, ASawtoothThatAJointFollowsBackIsNoTurn) {
  for (const double size : {6.2, 2 * M_PI}) {
    Servo servo(2 * M_PI / 4096, [&](double t) { return size * (t - std::floor(t)); });
    double q = 0;
    for (std::size_t i = 0; i < servo.position.size(); ++i) {
      q += 0.1 * (servo.command[i] - q);
      servo.position[i] = servo.count_rad * std::round(q / servo.count_rad);
    }
    servo.writePosition([](double counts) { return counts; });
    const auto before = servo.trial.columns;
    mendCounts(servo.trial, &servo.mapping);
    EXPECT_EQ(servo.trial.columns, before) << size;
    EXPECT_THAT(servo.trial.notes, IsEmpty());
  }
}

TEST(Counts, ACommandThatIsHeldForSeveralRowsIsFollowedToo) {
  Servo servo(2 * M_PI / 4096, [](double t) { return 0.3 + 5 * t; });
  for (std::size_t i = 0; i < servo.command.size(); ++i) servo.command[i] = servo.command[i - i % 10];
  servo.writePosition([](double counts) { return wrapped(counts, 4096); });
  servo.writeCommand([](double counts) { return wrapped(counts, 4096); });
  mendCounts(servo.trial, &servo.mapping);
  EXPECT_LT(servo.worst(2, servo.position), 1e-9);
  EXPECT_LT(servo.worst(1, servo.command), 1e-9);
}

TEST(Counts, ACommandThatJumpsIsReadAsItsJointShows) {
  // Steps about zero, and a servo that follows them.
  const auto steps = [](double t) {
    return std::fmod(t, 1.0) < 0.5 ? 0.4 + 0.1 * std::sin(t) : -0.3 - 0.1 * std::sin(2 * t);
  };
  for (const bool turn : {true, false}) {
    Servo servo(2 * M_PI / 4096, steps);
    double q = servo.command[0];
    for (std::size_t i = 0; i < servo.position.size(); ++i) {
      q += 0.2 * (servo.command[i] - q);
      servo.position[i] = servo.count_rad * std::round(q / servo.count_rad);
    }
    const auto written = [&](double counts) { return turn ? wrapped(counts, 4096) : signMagnitude(counts, 15); };
    servo.writePosition(written);
    servo.writeCommand(written);
    mendCounts(servo.trial, &servo.mapping);
    EXPECT_LT(servo.worst(2, servo.position), 1e-9) << turn;
    EXPECT_LT(servo.worst(1, servo.command), 1e-9) << turn;
    EXPECT_THAT(servo.trial.notes, Contains(HasSubstr("as its joint's position shows")));
  }
}

TEST(Counts, TheMappingSaysItBeforehand) {
  Servo servo(2 * M_PI / 4096, spinning);
  servo.writePosition([](double counts) { return wrapped(counts, 4096); });
  const auto before = servo.trial.columns;
  servo.mapping.columns[1].wrap = 0;
  mendCounts(servo.trial, &servo.mapping);
  EXPECT_EQ(servo.trial.columns, before);
  // 1234 counts a turn, which nobody guesses.
  Servo odd(2 * M_PI / 4096, spinning);
  odd.writePosition([](double counts) { return wrapped(counts, 1234); });
  odd.mapping.columns[1].wrap = 1234;
  mendCounts(odd.trial, &odd.mapping);
  EXPECT_LT(odd.worst(2, odd.position), 1e-9);
  Servo sign(0.0015, swinging);
  sign.writePosition([](double counts) { return signMagnitude(counts, 13); });
  const auto written = sign.trial.columns;
  sign.mapping.columns[1].signBit = -1;
  mendCounts(sign.trial, &sign.mapping);
  EXPECT_EQ(sign.trial.columns, written);
  sign.mapping.columns[1].signBit = 13;
  mendCounts(sign.trial, &sign.mapping);
  EXPECT_LT(sign.worst(2, sign.position), 1e-9);
}

TEST(Counts, PositionAndCommandAreInTheSameTurn) {
  Servo servo(2 * M_PI / 4096, [](double t) { return -0.4 + 0.8 * std::sin(3 * t); });
  servo.writePosition([](double counts) { return wrapped(counts, 4096); });  // begins at 6.0 rad
  mendCounts(servo.trial, &servo.mapping);
  EXPECT_LT(servo.worst(2, servo.position), 1e-9);
}

}  // namespace
}  // namespace btr
