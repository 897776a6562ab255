#pragma once
#include <cmath>
#include <limits>
#include <string>

#include "core/gap/search/gap_report.h"

namespace btr {

/// A report as an analysis of five trials of a two-joint leg would write it: gear play at the knee, everything filled
/// in, with a channel whose name needs escaping where that is asked for.
inline GapReport sampleReport(const std::string& robot = "leg") {
  const std::string knee = robot + ".knee", hip = robot + ".hip";
  GapReport r;
  r.verdict = GapReport::Verdict::missingPhysics;
  r.sentence = "At " + knee +
               " 83 % of the excess error lies within 60 ms after velocity reversals. Gear play of 0.051 rad explains "
               "it: held-out error falls from 12.8 to 1.2 noise floors. Gear elasticity fits as well (1.02 times the "
               "error); the suggested recording would tell them apart.";
  GapReport::Located located{knee + ".position_rad", 0.91, "velocity_reversal", {}, {}, {knee + ".velocity_rad_s"}};
  located.regimes = {
      {"velocity_reversal", 0.83, 0.14, 1e-7}, {"low_speed", 0.31, 0.22, 0.03}, {"high_load", 0.12, 0.2, 0.8}};
  located.windows = {{0, {1.2, 1.34}}, {1, {2.6, 2.71}}};
  r.located = {located, {hip + ".position_rad", 0.09, "", {}, {}, {}}};

  GapReport::Effect backlash{"backlash",
                             knee,
                             {{"width_rad", "rad", 0, 0.051, {0.047, 0.055}, false, true},
                              {"damping_nm_s_rad", "N·m·s/rad", 0, 0.01, {0, 0.2}, true, false}},
                             true,
                             0.71,
                             0.0004,
                             1,
                             0.64,
                             "held-out error falls in 38 of 40 blocks",
                             {}};
  backlash.rivals = {{"gear_elasticity", knee, 1.02}};
  backlash.qValue = 0.0076;
  r.tried = {
      backlash,
      {"gear_elasticity",
       knee,
       {{"stiffness_nm_rad", "N·m/rad", std::numeric_limits<double>::infinity(), 8.1, {7.2, 9.3}}},
       false,
       0.70,
       0.0006,
       2,
       0.61,
       "not worse than backlash, but less simple",
       {}},
      {"coulomb_friction",
       knee,
       {{"torque_nm", "N·m", 0, 0.004, GapReport::Interval::none()}},
       false,
       0.02,
       0.31,
       3,
       0.07,
       "its size is within two standard errors of nothing",
       {}},
      {"payload", robot + ".lower", {}, false, 0, 1, 17, 0.001, "explains nothing that the calibration does not", {}}};
  r.calibrated = {{"robots." + robot + ".servos.knee.p", "N·m/rad", 4.0, 3.71, {3.6, 3.8}, false, true},
                  {"robots." + robot + ".links.lower.mass_kg",
                   "kg",
                   0.08,
                   0.12,
                   {0.02, std::numeric_limits<double>::infinity()},
                   true,
                   false}};
  r.strongCorrelations = {"robots." + robot + ".servos.knee.p ~ robots." + robot + ".links.lower.mass_kg: 0.98"};
  r.channels = {{knee + ".position_rad", "rad", 0.0016, 0, 0.041, 0.022, 0.0019, 0.033, 0.017, 0.0015, 0.043, 0.024,
                 0.002, 0.034, 0.018, 0.0016, 0.0002},
                {hip + ".position_rad", "rad", 0.0015, 0, 0.006, 0.0031, 0.0017, 0.005, 0.0025, 0.0014, 0.0062, 0.0033,
                 0.0018, 0.0051, 0.0026, 0.0015, 0.0002}};
  r.ladder = {{"as given", 25.6, 1.9}, {"calibrated", 12.8, 1.1}, {"+ backlash at " + knee, 1.19, 0.05}};

  for (std::size_t k = 0; k < 5; ++k) {
    GapReport::Trial trial{
        "sine-" + std::to_string(k + 1) + ".csv", std::string(63, 'a') + std::to_string(k), k == 4, {}, {}};
    for (int i = 0; i < 500; ++i) trial.time_s.push_back(0.008 * i);
    for (const auto& [channel, share] : {std::pair{knee, 1.0}, std::pair{hip, 0.15}}) {
      GapReport::Series s{channel + ".position_rad", "rad", 0.0016, {}, {}, {}, {}};
      for (int i = 0; i < 500; ++i) {
        const double t = 0.008 * i, rate = 3 + 0.4 * static_cast<double>(k);
        const double play = share * 0.05 * std::exp(-8 * std::fmod(t * rate / 3.14159, 1.0));
        const double noise = 0.0016 * std::sin(12345.678 * (i + 1) * static_cast<double>(k + 1));
        s.recorded.push_back(0.6 * std::sin(rate * t) + noise);
        s.asGiven.push_back(0.6 * std::sin(rate * t - 0.05 * share) + play);
        s.calibrated.push_back(0.6 * std::sin(rate * t) + play);
        s.withEffects.push_back(i < 3 ? std::numeric_limits<double>::quiet_NaN() : 0.6 * std::sin(rate * t));
      }
      trial.series.push_back(s);
    }
    trial.setAside = k == 3;
    r.trials.push_back(trial);
  }
  r.remainder = {0.98,
                 knee,
                 "position",
                 "rad",
                 "N·m",
                 {-0.6, -0.2, 0.2, 0.6},
                 {0.004, -0.001, 0.002, 0.006},
                 {0.001, 0.001, 0.001, 0.002},
                 0.34,
                 0.02};
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  r.law = {knee,
           "detent",
           "a torque at " + knee +
               " that depends on position alone: pulls toward 0.35 rad, at most 0.25 N·m, within "
               "±0.1 rad; like a detent",
           {{"position",
             "rad",
             "N·m",
             {0.15, 0.25, 0.35, 0.45, 0.55},
             {0, 0.25, 0, -0.25, 0},
             {-0.02, 0.22, -0.01, -0.28, unknown},
             {0.02, 0.28, 0.01, -0.22, unknown}}},
           0.34,
           0.992,
           0.0002,
           1.1,
           1.4};
  r.explainedShare = 0.98;
  r.disagreements = {{"sine-4.csv", std::string(63, 'a') + "3",
                      "its robots." + robot + ".links.lower.mass_kg would have to be 0.21 kg instead of 0.12", true, 31,
                      1.2, 1.3}};
  r.next = {"separates backlash from gear_elasticity at " + knee, 7.4, {"time_s", knee + ".command_rad"}, {{}, {}}};
  for (int i = 0; i < 400; ++i) {
    r.next.columns[0].push_back(0.01 * i);
    r.next.columns[1].push_back(0.3 * std::sin(0.5 * 0.01 * i * 0.01 * i * 8));
  }
  r.notes = {"sine-3.csv: 4 samples are missing at 1.9 s",
             "without a measured torque masses and torques share a scale: the mass was held"};
  r.before.values = {{"robots." + robot + ".servos.knee.p", 4.0}};
  r.after.values = {{"robots." + robot + ".servos.knee.p", 3.71}};
  r.after.effects = {{"backlash", knee, {{"width_rad", 0.051}, {"damping_nm_s_rad", 0.01}}}};
  r.seed = 18446744073709551615u;
  r.seconds = 41.5;
  r.version = "0.1.0";
  return r;
}

}  // namespace btr
