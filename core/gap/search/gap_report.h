#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/sim/effect.h"
#include "core/spec/simulator_spec.h"

namespace btr {

/// What a gap analysis says ("format": "uchilsim-gap-report-1"). A value; errors are in the unit of their channel
/// unless a comment says otherwise. "Error in noise floors" is a root mean square of (simulated − recorded)/noise
/// floor.
struct GapReport {
  /// partlyExplained: named effects are needed and stay when a learned law takes up the rest, which is significant.
  enum class Verdict { noMismatch, parametersSuffice, missingPhysics, partlyExplained, unexplained, notExcited };

  struct Interval {
    double low = 0, high = 0;
    /// Where none was found: rejected effects, numbers that were held.
    static Interval none() {
      return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    }
    bool known() const { return !std::isnan(low) && !std::isnan(high); }
  };
  /// A number that was fitted, in its own unit. `excited` is false where it is not identifiable from the recordings.
  /// `ci95` takes the accepted effects for granted.
  struct Number {
    std::string name, unit;
    double before = 0, value = 0;  ///< before: as given in the scene; an effect's neutral value
    Interval ci95;
    bool atBound = false, excited = true;
    /// `ci95` and what it would be with each rival in the place of its effect, which need not overlap, from end to
    /// end; none: no rival has this number.
    Interval amongRivals = Interval::none();
  };
  struct Rival {
    std::string effect, at;
    double heldoutErrorRatio = 1;  ///< its held-out error over that of the effect it competes with
    std::string with = {};         ///< not empty: only together with this effect at the same place
  };
  /// A candidate that was looked at, accepted or not. Accepted ones are "effects" of the report, all are "tried".
  struct Effect {
    std::string effect, at;
    std::vector<Number> parameters;
    bool accepted = false;
    double heldoutErrorReduction = 0;  ///< 1 − error with it / error without, cross-validated (see Channel)
    double pValue = 1;                 ///< paired test on that error by blocks
    int screenRank = 0;                ///< 1 the best of the screening; 0 was not ranked
    double screenShare = 0;            ///< of the excess error that its sensitivity explains beyond the calibration
    std::string reason;                ///< why it was accepted or rejected, one clause for people
    std::vector<Rival> rivals;         ///< "indistinguishable_from"
    /// The p-value adjusted for all effects at all places that its round looked at (false discovery rate, see
    /// search_discoveries.h); NaN: not known.
    double qValue = std::numeric_limits<double>::quiet_NaN();
    EffectLaw law = {};  ///< as its plugin says it; empty where it says nothing, as in reports of earlier versions
  };
  /// Where the error lies that calibration leaves.
  struct Regime {
    std::string name;  ///< "velocity_reversal", "low_speed", "high_load", …
    double shareOfExcess = 0, shareOfTime = 0;
    double pValue = 1;  ///< of the share being larger than the time's
  };
  struct Window {
    std::size_t recording = 0;  ///< index into trials
    Interval time_s;
  };
  struct Located {
    std::string channel;
    double shareOfExcess = 0;
    std::string when;  ///< the regime that stands out most, "" if none does
    std::vector<Regime> regimes;
    std::vector<Window> windows;  ///< where most of it lies, largest first
    std::vector<std::string>
        dependsOn;  ///< channels, or what was made of them, on which the error depends; strongest first
  };
  /// "Cross-validated": alternate blocks of the trials predict each other, with the numbers as either half would have
  /// them, one linear step from the fit to everything (score.h). Initial states, and which effects there are, were
  /// found on everything. As given, nothing but initial states is fitted. NaN where a fault ended a simulation.
  struct Channel {
    std::string name, unit;
    double noiseFloor = 0;         ///< r.m.s. over the samples of the recordings that were fitted
    double heldoutNoiseFloor = 0;  ///< of the --held-out recordings, where it is another: stamps that jitter make it
                                   ///< larger where a motion is faster; 0: the same
    double asGiven = 0, calibrated = 0, withEffects = 0;                       ///< RMSE, cross-validated
    double maeAsGiven = 0, maeCalibrated = 0, maeWithEffects = 0;              ///< mean absolute error, the same
    double heldoutAsGiven = 0, heldoutCalibrated = 0, heldoutWithEffects = 0;  ///< RMSE, --held-out recordings
    double heldoutMaeAsGiven = 0, heldoutMaeCalibrated = 0, heldoutMaeWithEffects = 0;  ///< MAE, the same
    double stepError = 0;  ///< RMS error of the integration itself in the final simulator
    double heldoutFloor() const { return heldoutNoiseFloor > 0 ? heldoutNoiseFloor : noiseFloor; }
  };
  /// A rung of the ladder down to the noise floor.
  struct Step {
    std::string what;          ///< "as given", "calibrated", "+ backlash at leg.knee", "− coulomb_friction at …"
    double error = 0;          ///< in noise floors, cross-validated (see Channel)
    double standardError = 0;  ///< of it, over blocks
  };
  struct Series {
    std::string channel, unit;
    double noiseFloor = 0;
    std::vector<double> recorded, asGiven, calibrated, withEffects;  ///< by the trial's time; NaN where unknown
  };
  struct Trial {
    std::string name, sha256;
    bool heldOut = false;  ///< never used in any fit
    std::vector<double> time_s;
    std::vector<Series> series;
    bool setAside = false;  ///< not used in the fit or the tests of effects: see Disagreement
  };
  /// A trial that one simulator does not fit together with the others.
  struct Disagreement {
    std::string trial, sha256;
    std::string what;      ///< one sentence: "its spin_x would have to be -310 rad/s instead of 243"
    bool setAside = true;  ///< false: named only, and fitted like the others
    /// Its error by a fit to the others, by a fit to it alone, and the median of the others' [noise floors].
    double error = 0, errorAlone = 0, errorOfOthers = 0;
  };
  /// One curve of a measured law: a generalised force over a variable.
  struct LawCurve {
    std::string on;  ///< "position", "velocity", "direction", "load", "time", "angle" (position modulo its period), …
    std::string unitX, unitY;
    std::vector<double> x, y, low, high;  ///< low, high: the band, 95 % of each y by itself; NaN where unknown
  };
  /// A force without a name that was learned from the recordings and belongs to the final simulator as the effect
  /// measured_law: the sum of its curves. Nothing was learned where there are none.
  struct MeasuredLaw {
    std::string at;
    std::string family;    ///< "detent", "cam", "hardening spring", "dead zone", "drift"; "": none fits as well
    std::string sentence;  ///< on what it depends, where, how large
    std::vector<LawCurve> curves;
    double shareOfRest = 0;     ///< of what named effects leave of the cross-validated squared error, what it takes
    double explainedShare = 0;  ///< as GapReport::explainedShare, with it
    double pValue = 1;          ///< paired test by blocks
    double error = 0, errorWithout = 0;  ///< with named effects and it, with named effects alone [noise floors]
    bool known() const { return !curves.empty(); }
  };
  /// A force that nobody has named: generalised force at `at` over a variable.
  struct Remainder {
    double explainedShare = 0;  ///< of the excess of the calibrated simulator, by the accepted effects
    std::string at, on;  ///< joint, and "position", "velocity", "load", "time"; empty: nothing significant is left
    std::string unitX, unitY;
    std::vector<double> x, y, standardError;
    double shareOfRest = 0;  ///< of the remaining held-out excess that the curve takes away
    double pValue = 1;
  };
  struct NextRecording {
    std::string why;                    ///< "separates backlash from gear_elasticity at leg.knee"
    double separation = 0;              ///< expected difference of the rivals [noise floors, RMS]; 0: none was designed
    std::vector<std::string> channels;  ///< time_s and the commands
    std::vector<std::vector<double>> columns;  ///< by channel
  };

  Verdict verdict = Verdict::notExcited;
  std::string sentence;                         ///< the whole finding in a few sentences
  std::string nextStep;                         ///< what to do first, where the verdict alone does not tell it; or ""
  std::vector<Located> located;                 ///< largest share first
  std::vector<Effect> tried;                    ///< accepted first, then by held-out gain
  std::vector<Number> calibrated;               ///< names are the scene's paths
  std::vector<std::string> strongCorrelations;  ///< "P ~ Q: 0.99", pairs that the recordings hardly separate
  std::vector<Channel> channels;
  std::vector<Step> ladder;
  std::vector<Trial> trials;
  Remainder remainder;
  MeasuredLaw law;
  /// Of the cross-validated squared error as given, what calibration and named effects take away (0 … 1); NaN unknown.
  double explainedShare = std::numeric_limits<double>::quiet_NaN();
  std::vector<Disagreement> disagreements;
  NextRecording next;
  bool cutShort = false;           ///< AnalysisOptions::isEnough: more may be missing than is named
  std::vector<std::string> notes;  ///< doctor's findings, gauge freedom, integration error, what was skipped
  /// As given; calibrated with the accepted effects. The same where the verdict leaves nothing to adopt.
  SimulatorSpec before, after;
  std::string scene, sceneSha256;  ///< file that was analysed (absolute), and its bytes; "" where there was none
  std::uint64_t seed = 1;
  double seconds = 0;  ///< wall time; not part of what must be reproducible
  std::string version;
  double step_s = 0;    ///< of the replays that scored `after`; 0: the scene's. Not kept in the folder
  double window_s = 0;  ///< of the same: length of their segments, 0: whole trials. Not kept in the folder
};

}  // namespace btr
