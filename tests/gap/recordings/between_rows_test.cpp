// What a drive is told between two rows.
#include "core/gap/recordings/between_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/gap/recordings/mapping.h"
#include "core/spec/error.h"

namespace btr {
namespace between_rows {

using What = Binding::Input::What;

/// A command every 5 ms.
Recording logged(double (*command)(double)) {
  Recording trial;
  trial.source = "trial.csv";
  trial.channels = {"time_s", "leg.knee.command_rad"};
  trial.columns.resize(2);
  for (int i = 0; i < 400; ++i) {
    trial.columns[0].push_back(0.005 * i);
    trial.columns[1].push_back(command(0.005 * i));
  }
  return trial;
}

double sine(double t) { return 0.6 * std::sin(3 * t); }
double steps(double t) { return std::fmod(t, 1) < 0.5 ? 0.4 : -0.4; }
/// New every 10 ms, in every other row.
double held(double t) { return sine(std::floor(t / 0.01 + 1e-9) * 0.01); }

Binding::Input of(What what) { return {what, 0, 0, 1}; }

TEST(BetweenRows, ASmoothCommandIsWhereAStraightLineHasIt) {
  Recording trial = logged(sine);
  EXPECT_EQ(inputFrom(trial, of(What::command), 100), sine(0.5)) << "as it is written, if nothing says otherwise";
  trial.betweenRows = 0.5;
  // A straight line is off by an eighth of the second difference.
  EXPECT_NEAR(inputFrom(trial, of(What::command), 100), sine(0.5025), 0.6 * 9 * 0.005 * 0.005 / 8 + 1e-12);
  trial.betweenRows = 0.2;
  EXPECT_NEAR(inputFrom(trial, of(What::command), 100), sine(0.501), 0.6 * 9 * 0.005 * 0.005 / 8 + 1e-12);
  EXPECT_EQ(inputFrom(trial, of(What::motion), 100), sine(0.5)) << "a path that is followed is known at its rows";
  EXPECT_EQ(inputFrom(trial, of(What::command), 399), sine(0.005 * 399)) << "nothing follows";
}

TEST(BetweenRows, StepsAndEmptyCellsHold) {
  Recording trial = logged(steps);
  trial.betweenRows = 0.5;
  for (std::size_t row = 0; row < trial.rows(); ++row)
    EXPECT_EQ(inputFrom(trial, of(What::command), row), trial.columns[1][row]) << row;
  Recording gaps = logged(sine);
  gaps.betweenRows = 0.5;
  gaps.columns[1][101] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(inputFrom(gaps, of(What::command), 100), gaps.columns[1][100]);
}

TEST(BetweenRows, ItIsOpenWhereNothingSaysThatCommandsHold) {
  Binding binding;
  binding.inputs = {of(What::command)};
  Scene scene;
  scene.controlPeriod_s = 0.001;
  EXPECT_TRUE(mayGoOnBetweenRows(scene, logged(sine), binding));
  EXPECT_FALSE(mayGoOnBetweenRows(scene, logged(steps), binding));
  EXPECT_FALSE(mayGoOnBetweenRows(scene, logged(held), binding)) << "it is seen to hold";
  Recording told = logged(sine);
  told.betweenRows = 0;
  EXPECT_FALSE(mayGoOnBetweenRows(scene, told, binding));
  scene.controlPeriod_s = 0.005;
  EXPECT_FALSE(mayGoOnBetweenRows(scene, logged(sine), binding)) << "rows and commands have one rhythm";
}

TEST(BetweenRows, AMappingSaysIt) {
  EXPECT_FALSE(mappingFromJson(R"({"lost_rows": "hold"})", "m.json").betweenRows);
  EXPECT_EQ(mappingFromJson(R"({"between_rows": "hold"})", "m.json").betweenRows, 0.0);
  EXPECT_EQ(mappingFromJson(R"({"between_rows": "line"})", "m.json").betweenRows, 0.5);
  EXPECT_EQ(mappingFromJson(R"({"between_rows": 0.3})", "m.json").betweenRows, 0.3);
  EXPECT_THROW(mappingFromJson(R"({"between_rows": "smooth"})", "m.json"), InputError);
  EXPECT_THROW(mappingFromJson(R"({"between_rows": 0.7})", "m.json"), InputError);
}

}  // namespace between_rows
}  // namespace btr
