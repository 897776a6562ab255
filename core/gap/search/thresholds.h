#pragma once
#include <array>
#include <cstddef>

namespace btr {

/// All numbers that decide what a gap analysis tries, fits, accepts and says. One set serves all scenes; nothing adapts
/// them to a recording. Where a number came from stands behind it in brackets:
///
/// - [prototype] 150 simulated recordings of one joint, analysed by a throw-away program: BIC and F-test alone accepted
///   a false effect in 6 of 7 healthy cases, these conditions none in 37;
/// - [case] came with a change that mended a kind of case, which the comment names, of blind trials (`btr gap prove`)
///   or real recordings (resources/results.md);
/// - [statistics] follows from the named distribution;
/// - [order] follows from the integrator's order;
/// - [numeric] keeps rounding errors out;
/// - [time] bounds the work, chosen by hand;
/// - [hand] chosen by hand, nothing more is known.
///
/// Errors are mean squared errors in noise floors² (1: noise alone) unless a comment says otherwise, their excess is
/// what lies above 1; costs are sums over all residuals (fit.h); gains are shares of the error without the effect.
struct SearchThresholds {
  /// The integration step that models are fitted, scored and compared with.
  struct Step {
    int iterations = 3;  ///< of what was fitted with another step [time]
    /// noise floors, RMS: a coarser step may change so much where effects are looked for [hand]
    double harmless = 0.3;
    double ofError = 0.1;             ///< or so much of the error that there is to explain [hand]
    double muchError = 5;             ///< noise floors, RMS: from here on what is unexplained is much [hand]
    double ofMuchError = 0.3;         ///< of that a coarser step may change so much [time]
    double hidden = 0.12;             ///< noise floors, RMS: what half the step may change of what is judged [hand]
    double hiddenOfError = 0.05;      ///< or so much of its error: a four hundredth of its square [hand]
    double hiddenOfMuchError = 0.15;  ///< the same where much is unexplained: a fiftieth of its square [time]
    /// noise floors, RMS: with more left the step is not what matters, if it is the scene's [time]
    double mostError = 10;
    double settled = 0.7;   ///< of the change by half the step, left at the finest: more, and the step stays, as where
                            ///< feet land another way with each step [hand]
    double coarser = 1.01;  ///< factor: steps nearer to each other are the same [numeric]
    double farWorse = 2;    ///< by cost, of the best: no winner at any step, so left at a coarse one [time]
    int withoutIterations = 12;  ///< of a model that lacks one of its effects [time]
  };

  /// The numbers of the scene: fitted first, and what stays as given.
  struct Calibration {
    int iterations = 15;          ///< from the numbers as given [time]
    double leastForStarts = 0.6;  ///< cost per residual from which drawn starts are tried; noise alone costs 0.5 [hand]
    double startSpread = 2;       ///< typical changes to either side that starts are drawn from [hand]
    int startIterations = 10;     ///< of those [time]
    int scanned = 9;              ///< places in each number's range that are replayed, twice [time]
    std::size_t hypercubePerNumber = 6, hypercubeMost = 48;  ///< and of all numbers together [time]
    std::size_t scannedSegments = 6;                         ///< from all over the recordings, for that [time]
    std::size_t scanFitted = 3;                              ///< of these places, the best, that are fitted [time]
    double apart = 0.08;         ///< of its range: some number of one is so far from that of another [hand]
    int againIterations = 15;    ///< with the initial states of trials that got stuck begun anew [time]
    int drawnIterations = 15;    ///< of a walk, from the best of drawn replays [time]
    double sensitive = 0.5;      ///< noise floors, all residuals together: a typical change of a number that changes
                                 ///< less is held [hand]
    double unstableRatio = 1.5;  ///< held-out error over that of the fit; more in free runs asks for windows [hand]
    double unstableError = 1.3;  ///< and held-out error of at least this [hand]
    double chiSquared95 = 3.84;  ///< χ² of one number: what going back to the value as given may cost [statistics]
    double unreached = 0.1;      ///< of all squared residuals: what is unknown above changes less [case: wind-up]
    double farFromGiven = 2;     ///< typical changes: a calibration that moved a number farther may have bent it [hand]
    double muchLeft = 1;         ///< and excess from which effects are looked for from the numbers as given, too [hand]
    double leastToFitOn = 0.1;   ///< excess at which what was accepted is fitted on [case: curved valleys]
    int toTheEnd = 30;           ///< iterations of what was accepted and of its rivals [time]
  };

  /// Where a fit is begun again to leave a side minimum. "Better" is the cost after over the cost before.
  struct Restarts {
    int iterations = 15;                             ///< from a better start [time]
    double better = 0.995;                           ///< by replays, or by a few iterations [hand]
    std::array<double, 4> sizes{1, 0.5, 0.8, 1.25};  ///< of the last effect, side minima of friction and play [hand]
    std::array<double, 2> alongSizes{0.9, 1.1};      ///< steps along a rough valley [case: rolling balls in wind]
    int heldIterations = 8;                          ///< of all else with the effect held [time]
    int alongRounds = 4;                             ///< steps at most [time]
    double alongBetter = 0.998;                      ///< for the next step along the valley [hand]
    double alongInReach = 1.02;                 ///< by cost, with the effect held: with more it is not set free [hand]
    std::array<double, 3> farSizes{0.5, 2, 4};  ///< far off, as from a quarter of a play's width [case: play]
    double farBetter = 0.98;                    ///< [hand]
    std::array<double, 6> neighbours{-3, -2, -1, 1, 2, 3};  ///< of a whole number [hand]
    std::array<double, 2> harmonics{0.5, 2};  ///< times it: what repeats is taken for these [case: held loops]
    int neighbourIterations = 3, neighbourBestIterations = 8;  ///< of each, of the best two [time]
    std::size_t neighboursFittedOn = 2;
    int neighbourRounds = 6;       ///< moves at most [time]
    int drawRounds = 6;            ///< of drawn replays, each in half the width of the last [hand]
    std::size_t draws = 24;        ///< a round; a replay costs a tenth of a Jacobian [time]
    double drawCloser = 0.5;       ///< width of a round over that of the last [hand]
    double decade = 10;            ///< an effect's number whose bounds are farther apart is drawn by magnitude [hand]
    int wholeIterations = 15;      ///< over whole trials, after windows [time]
    double windowSamples = 8;      ///< at least, in a window: to know its beginning [hand]
    double windowsReplayed_s = 8;  ///< windows from all over the recordings, together [time]
    double longer = 4;             ///< a window over the one before [hand]
    double longestWindow_s = 3;    ///< then whole trials [hand]
    int windowIterations = 8;      ///< in the first windows [time]
  };

  /// Whole numbers (waves of a ripple in a turn) begun in short windows. [case: hard ripples]
  struct WholeNumbers {
    double leastLeft = 4;    ///< error of a candidate from which they are looked for again [case]
    double step = 0.02;      ///< of large numbers, as a share of them: neighbours look alike [time]
    double small = 0.1;      ///< of a usual size: what it does is in proportion [hand]
    double apart = 0.05;     ///< as a share of the number: nearer ones are climbed to [time]
    double around = 1.3;     ///< of what is no wave: from the fit's own number by this factor down and up [hand]
    double most = 24;        ///< different ones of these [time]
    double window_s = 0.1;   ///< a motion begun anew stays near so long, whatever is wrong [hand]
    std::size_t fitted = 3;  ///< numbers that are fitted [time]
    double inReach = 2;      ///< by cost in windows, of the best: fitted on in longer ones [time]
  };

  /// An effect's own numbers drawn all over their ranges in short windows. [case: large play was called friction]
  struct DrawnEffects {
    double leastLeft = 1.3;    ///< error that the best candidate leaves, from which it is done [hand]
    double window_s = 0.4;     ///< rough over whole trials, one hollow over all widths of play in these [case]
    double inReach = 1.5;      ///< by squared error in windows, of the best [time]
    int raceFrom = 2;          ///< rounds of draws, after which candidates that are out of the race are left [time]
    double race = 2.25;        ///< by squared error, of the best so far: out of it [time]
    double helps = 0.95;       ///< by squared error in windows, of that without it, before anything is fitted [time]
    double helpsAtAll = 0.99;  ///< by the error's size in windows, of that without it: else drawing ends [hand]
    double mostLeft = 4;       ///< error of what may be the cause; of other laws a better fit says nothing [case]
    double hopeless = 4;       ///< times mostLeft in short windows: whole trials leave more [time]
  };

  /// Which effects are tried at all, where and in which sizes (candidates.h).
  struct Candidates {
    double wholeNumbersWider = 1.25;    ///< from one whole number that is tried to the next [hand]
    std::size_t wholeNumbersMost = 26;  ///< that are tried [time]
    double wideRange = 20;              ///< maximum over minimum: tried at the default and around it by `aroundDefault`
    double aroundDefault = 4;           ///< factor [hand]
    double rangeLow = 0.25, rangeHigh = 0.75;  ///< places in a narrow range [hand]
    double nearNothing = 12;      ///< of lengths to either side, a part of the range [case: bodies of all sizes]
    double standsStill = 12;      ///< noise floors: six standard deviations to either side [statistics: normal]
    double typicalOfRange = 0.1;  ///< a size without a default [hand]
    double smallSize = 0.2;       ///< of a typical size, tried too [hand]
    std::array<double, 2> largeSizes{4, 16};  ///< the same [case: play and limits are not linear]
    double mostKinds = 5;                     ///< whole numbers that are kinds and not counts, each fitted [hand]
    double leastPeriods = 2;                  ///< that a motion must pass for them to be counted [case]
    double endInside = 0.1;                   ///< of the motion: where ends of a free range are looked for first [hand]
  };

  /// Linear screening: what each candidate promises (screen.h), and which are fitted.
  struct Screening {
    double sensitivePerResidual = 0.01;  ///< squared change per residual that counts as sensitive, but [hand]
    double sensitiveMost = 25;           ///< no more is asked of all residuals together: five standard errors [hand]
    double indistinct = 1e-6;  ///< of a squared change that the fitted numbers leave: they can do as well [numeric]
    double largestStep = 20;   ///< linear, times the size that was tried [hand]
    /// times the usual size, tried where that changes nothing [case: creep on carpet]
    std::array<double, 2> insensitiveSizes{50, 500};
    std::size_t insensitiveVariants = 2;  ///< in these sizes [time]
    /// Of the size that was tried, what is wanted; and the squared change over all that is to be explained: a law is no
    /// longer near proportional to its size then [case: a spring of 1.7 mN·m/rad on an arm of a few grams]
    double farTooLarge = 0.05, muchMore = 25;
    std::size_t smallerVariants = 2;  ///< of such a candidate in smaller sizes [time]
    int smallerRounds = 3;            ///< for each: smaller and smaller [time]
    double worthLooking = 0.005;      ///< promised gain from which a replay looks at what was promised [hand]
    std::array<double, 4> lookedAt{1.0, 0.1, 0.3, 3.0};  ///< times the promised size; the first as promised [hand]
    std::size_t many = 60;           ///< candidates: then a third of the segments is looked at first [time]
    std::size_t promising = 40;      ///< that are screened in full then [time]
    std::size_t firstVariants = 2;   ///< of each, and of each of its whole numbers, at the first look [time]
    std::size_t segmentsPart = 3;    ///< one of so many segments, the worst ones [time]
    std::size_t fitted = 8;          ///< half of them to the end. The truth was among the first ten in 92 of 106 cases,
                                     ///< first in 61 [prototype]
    std::size_t fittedInPairs = 4;   ///< beside another [time]
    std::size_t fittedAsRivals = 6;  ///< in the place of another [time]
    double leastOfGain = 0.7;        ///< promise, of the least gain that is accepted [hand]
    double leastOfBest = 0.1;        ///< promise, of the best one's [hand]
    int iterations = 8;              ///< of the first fits [time]
    double hopeless = 4;             ///< by cost, of the best after those: no rival [hand]
    double inReach = 16;  ///< by cost: a wrong number of waves leaves many times what the right one does [case]
    double lastChanceExcess = 0.3;  ///< before nothing is said to help with more left, others are fitted, too; also
                                    ///< the least at which pairs are tried [prototype]
    std::size_t lastChance = 16;    ///< candidates then [time]
    std::size_t lastChanceConfirmed = 4;  ///< of those [time]
    double lastChancePromise = 0.01;      ///< least promise of those [hand]
    double aboutAsMuch = 0.25;            ///< promise of those, of the best one's, where the best is found and leaves
                                          ///< more than lastChanceExcess [case: a sensor's lag of 48 ms]
    double nothingLeft = 1.03;            ///< error, less that of the integration: nothing is looked for [hand]
    double nothingUnderTorques = 1.5;     ///< the same where floors are the noise of recorded torques, which a few
                                          ///< windows tell to a quarter [arithmetic]
    double imperfect = 1e-3;              ///< of what the effects take, and no more than
    double imperfectMost = 0.8;           ///< may be left of it: their laws are not the plant's in every detail [case:
                                          ///< dry friction that another integrator smooths]
    std::size_t fromGiven = 4;            ///< fitted beside the numbers as given, too [case: viscous friction that a
                                          ///< calibration took for a third of the gain]
    std::size_t pairFirsts = 2;           ///< candidates that others are tried beside [time]
    double pairPromise = 0.03;  ///< least promise: two effects that need each other show a little by themselves [hand]
    double littleOfExcess = 0.01;  ///< of the calibrated simulator's: so little, and no more than
    double littleExcess = 3;    ///< (two noise floors), left by what was found: no pair is looked for beside it [time]
    double doubtfulExcess = 1;  ///< left by one effect: two others in its place are tried [case: payload
                                ///< beside a servo of any strength]
  };

  /// What counts as an effect. Fewer conditions let false effects in.
  struct Confirmation {
    double leastT = 2.5;               ///< paired t over blocks, not fitted to against fitted without it [prototype]
    double leastGain = 0.01;           ///< of the held-out error [prototype]
    double leastShareOfExcess = 0.08;  ///< of the excess [prototype]
    double leastErrors = 6;            ///< its size, standard errors from neutral [prototype]
    double mostFalse = 0.05;           ///< share of false ones among all accepted, on average: q-value (Benjamini and
                                       ///< Hochberg 1995) [hand: usual]
    double largeExcess = 1;       ///< from which standard errors, made rough by bounces and reversals, are not asked
    double mostOfExcess = 0.5;    ///< of what takes more than this of it [case: real arms]
    double timesIntegration = 4;  ///< taken, over what half the step changes: half of the error, a quarter of its
                                  ///< square [order]
    double largerSize = 1.5;      ///< times as large: friction that holds a joint is known from below only, if this
    double flat = 1e-3;           ///< changes the cost by less than this of what the effect takes [hand]
    int iterations = 15;          ///< of the last fits [time]
    double worthMore = 1.5;       ///< by cost, of the best: restarts are tried; where feet walk, [time]
    double worthMoreOfWalks = 1;  ///< only of the best itself [time]
    double worthShare = 1.0 / 3;  ///< and of what takes so much of what the best takes [time]
    double leastForFarSizes = 1.3, mostForFarSizes = 10;  ///< error: between them far sizes are tried; with more, a
                                                          ///< better start does not help [hand]
    double leastForValley = 1.03, mostForValley = 4;  ///< error: between them valleys are followed; with less nothing
                                                      ///< is missed, with more it is no valley's bottom [hand]
    std::size_t decideStep = 2;  ///< candidates, the most promising ones, that may ask for a finer step [time]
    double missedT = 2;          ///< t from which a model without something predicts worse: it stays. Less is asked
                                 ///< than to come in, about 2.5 % one-sided [statistics]
  };

  /// Details of the laws that were found (Parameter::refines).
  struct Refinement {
    std::array<double, 4> shares{0.003, 0.02, 0.1, 0.4};  ///< of the allowed range, where their fits begin [hand]
    int iterations = 15;                                  ///< of these [time]
  };

  /// An effect beside a simpler form of itself: where the sizes of the one that stays are looked for.
  struct Merging {
    /// of a typical size [case: a share of a thirteenth, the rest under the other name]
    double smallest = 1.0 / 64, largest = 4096, ratio = 1.4;
  };

  /// What would explain the recordings as well, and what stands in another's place.
  struct Rivals {
    /// of a paired comparison: another one is refuted (t as missedT) [statistics]
    double worseT = 2, worseGain = 0.01;
    double gainOfNoise = 0.05;  ///< where another leaves no more than noise, less than this does not refute it:
                                ///< sensors of counts are no dice [case]
    double fitsWorse = 1.005;   ///< by cost: what fits as well and predicts worse only pays for a number more [case:
                                ///< gravity that leans and a sensor's offset are one law]
    double equals = 1.25;       ///< by error, where a paired test does not tell them apart [case: simpler laws]
    double ofEquals = 0.95;     ///< by error and by cost: of two with as many numbers it has the name [case: drag of a
                                ///< ball by its speed or by the square of that]
    double allThatShows = 1.1;  ///< by error, of a richer one of whose sizes no more show: the simpler has the name
                                ///< [case: friction by load with shares of 0 to 0.03]
    double nothingShows = 5;    ///< the same of one none of whose sizes shows [case: dry friction of filtered torques
                                ///< as friction that fades at once with any coefficient]
    double ofMuchLeft = 0.1;    ///< of the excess: so much more may a simpler form leave [hand]
    double clearlyBetterGain = 0.01;  ///< to replace what was found, with confirmation.leastT [prototype]
    int rounds = 2;                   ///< of rivals, and of effects beside what took a place [time]
    int replaced = 3;                 ///< times at most that one takes another's place [time]
    int apartIterations = 25;         ///< of simpler forms in the place of a richer one [time]
    int togetherIterations = 15;      ///< of two that say the same together [time]
    std::size_t screened = 16;        ///< for an effect's place in full, after a first look at all [time]
    std::size_t handedTo = 6;         ///< candidates that an effect's place is handed over to bit by bit [time]
    double leastPromise = 0.25;       ///< of the best one's [hand]
    double valley = 4;                ///< times the final cost on the way: farther is out of the valley [case]
    double valleyEnd = 2;             ///< and where nothing of the effect is kept [hand]
    std::array<double, 3> kept{0.7, 0.35, 0};  ///< of the effect's size, step by step [hand]
    double small = 0.1;                        ///< of a typical size, where the way begins: all is linear there [hand]
    int wayIterations = 18;                    ///< a step of the way; what arrives is fitted on [time]
    double wayTolerance = 2e-3;                ///< of its cost [time]
    /// of a typical size: simpler forms are tried in all these, as no fit finds them [case: dry friction]
    double smallestForm = 0.02, largestForm = 50, formRatio = 1.15;
    std::array<double, 4> formCloser{0.93, 0.97, 1.03, 1.07};  ///< and around the best of them [hand]
    double widerAmong = 2;  ///< times its own interval: a number's interval over all rivals is reported [hand]

    /// Screening that takes a first look at all, and few in full.
    Screening of(Screening usual) const {
      usual.many = usual.promising = screened;
      return usual;
    }
  };

  /// Where the error lies that calibration leaves (locate.h): describes, decides nothing.
  struct Location {
    double window_s = 0.2, windowSamples = 20;  ///< windows from the recorded state: the longer of both [hand]
    double sensitive = 1.15;                    ///< error below which the windows are too short to see it [hand]
    double leastExcess = 0.1;                   ///< a residual: less is located nowhere [hand]
    double leastOfChannels = 0.05;              ///< share of a channel that is reported [hand]
    double leastP = 0.02;                       ///< p-value of a regime that stands out [hand: usual]
    double standsOut = 1.3;                     ///< its share of the excess over that of the time [hand]
    int turns = 199;          ///< of the same pattern of time, for p-values in steps of 1/200 [statistics]
    double rate_s = 0.01;     ///< slopes through samples so far to either side [hand]
    double saturated = 0.98;  ///< of the servo's largest torque [hand]
    double onFloor = 1.05;    ///< radii of a ball's height [hand]
    double fast = 0.9, heavy = 0.8, outer = 0.02;  ///< quantiles of speed, load, position (from either end) [hand]
    double reversal_s = 0.06;                      ///< after a change of direction [hand]
    double moves = 0.03;                           ///< of the fast speed: a direction [hand]
    double slowShare = 0.1, fastShare = 0.7;       ///< of the fast speed: low and high speed, and directions [hand]
    double endShare = 0.2;                         ///< of the range: low and high positions [hand]
    double late = 2.0 / 3.0;                       ///< of the trial [hand]
    std::size_t bins = 8, samplesPerBin = 20;      ///< of a variable on which the error may depend [hand]
    double dependence = 0.1;    ///< share of the error's variance that the bins explain: it depends on it [hand]
    double stretch_s = 0.2;     ///< stretches that hold most of the excess [hand]
    std::size_t stretches = 5;  ///< of them
  };

  /// A joint that swings by itself (self_excited.h): described, decides nothing. [case: seed 20261162]
  struct SelfExcitation {
    double leastPeriods = 3;        ///< in a third of a trial [hand]
    double bandwidth = 0.25;        ///< of the frequency, to either side [hand]
    double timesAnother = 25;       ///< power, over the command's and the simulator's: five times their swing [hand]
    double shareOfError = 0.5;      ///< of the third's error [hand]
    double leastFloors = 3;         ///< noise floors, r.m.s. [hand]
    std::size_t leastSamples = 30;  ///< in the third [hand]
  };

  /// A force without a name that is learned from the rest (remainder.h).
  struct Remainder {
    double leastExcess = 0.3;   ///< left, from which one is learned [hand]
    double leastT = 3;          ///< paired, against without it [prototype]
    double leastShare = 0.1;    ///< of the rest [hand]
    int iterations = 12;        ///< [time]
    double insteadError = 1.3;  ///< left by named effects, from which a curve in their place is tried [hand]
    double instead = 0.7;       ///< its error over theirs: names that a curve beats by 30 % are wrong [prototype]
    int insteadIterations = 8;  ///< of the calibration without them, before [time]
    /// a typical force: of the drive's strength, of the ball's weight [hand]
    double jointForce = 0.02, ballForce = 0.01;
  };

  /// A law that no effect of the library is, learned and adopted as curves (measured_law.h).
  struct Law {
    /// Trials of which each is predicted by others: a force over time that one recording needs says nothing of another,
    /// and parts of a trial share the knots between them. [case: a beam that swings, in one recording]
    static constexpr std::size_t timeNeedsTrials = 3;
    double leastExcess = 0.3;    ///< left beyond the integration's error, from which one is learned [hand]
    double ofStrength = 0.02;    ///< a typical force, of the drive's strength [hand]
    std::size_t joints = 2;      ///< that are looked at, those with the largest errors [time]
    int firstKnots = 11;         ///< of the first look [time]
    int knots = 25;              ///< of what is fitted: a detent is a tenth of a motion wide [hand]
    double reached = 0.01;       ///< of what the most sensitive knot changes: knots at an end that change less are not
                                 ///< reached by the recordings [case: real servo, 15 N·m where no trial was]
    double turnsForAngle = 1.5;  ///< of a joint's motion, from which its angle is a quantity of its own [hand]
    double leastPromise = 0.02;  ///< of the squared residuals of other trials [hand]
    std::size_t fitted = 3;      ///< options that are refined in replay, of those that promise [time]
    double ofBest = 0.5;         ///< as much as this of the best [hand]
    int firstIterations = 4;     ///< of these fits [time]
    int iterations = 10;         ///< of the best one's [time]
    int polishings = 3;          ///< as many again, at most, while they help [time]
    double settled = 0.9;        ///< of the error before: as many iterations that leave more are the last [hand]
    double leastT = 3;           ///< paired over blocks, against without it [prototype]
    double mostFalse = 0.01;     ///< p-value times the options that were looked at [hand: usual]
    double leastShare = 0.2;     ///< of the excess [hand]
    double secondShare = 0.2;    ///< of what the first curve leaves, for a second one [hand]
    double keepsSize = 3;        ///< a named effect's size may change by this factor with the law beside it [hand]
    double standsAlone = 0.7;    ///< error of a law alone over that of the names: names fall from here on [prototype]
    double asWell = 1.1;         ///< and over that of names and law together [hand]
    double asNamed = 0.99;       ///< of what a curve takes in a name's place: a name that takes this is no other law
                                 ///< [case: dry friction of an arm, once more as a curve over position]
  };

  /// Trials that one simulator does not fit together with the others (disagreement.h).
  struct Trials {
    std::size_t least = 4;       ///< trials, from which one of them can be told to be the odd one [hand]
    double keptShare = 0.6;      ///< that the trimmed fits go to: up to four of ten may be spoiled [hand]
    int trimmings = 4;           ///< fits to those that fit best, at most [time]
    int iterations = 6;          ///< of each [time]
    double farOff = 2.5;         ///< times the others' median error (r.m.s.): a trial stands out [hand]
    double leastZ = 3.5;         ///< and so many robust standard deviations of the logarithms [statistics: usual]
    double leastFloors = 2;      ///< noise floors: what is less does no harm [hand]
    double asOthers = 1.7;       ///< times the others' median error (r.m.s.): it agrees [hand]
    double worseTogether = 1.3;  ///< mean squared error with all, over that without: all do not fit together [hand]
    double unlike = 0.5;         ///< of its motion (r.m.s.), its error: it is something else that was recorded [hand]
    double range = 10;           ///< times its size, how far a number of a trial is looked for [hand]
    double beyondOthers = 1.2;   ///< times the others' reach or speed: it can show what they do not [hand]
    int rounds = 3;              ///< what is large hides what is small: looked for again without it [time]
  };

  /// The recording that would distinguish rivals (next_recording.h).
  struct NextRecording {
    /// of the sequence, its samples, its beginning at rest [hand]
    double length_s = 8, sample_s = 0.008, rest_s = 0.5;
    double beyond = 0.1;  ///< of the range in which a pushed joint was seen: it may go so much farther [hand]
    double reach = 0.95;  ///< of the recorded commands' reach [hand]
    std::array<double, 4> pushes{1, 0.5, 0.25, 0.1};  ///< of the reach of a push [hand]
    /// noise floors, RMS: what the 1000 samples of a designed recording distinguish, √1000 × 0.1 being three standard
    /// errors of one number [statistics]
    double leastSeparation = 0.1;
  };

  /// What the verdict and its sentence say.
  struct Verdict {
    double atNoise = 1.3;            ///< error: nothing is missing [hand]
    double stillNoise = 1.15;        ///< error beyond the integration's: nothing is left beside what was named [hand]
    double unexplained = 1.5;        ///< error: too much to stay without a name [hand]
    double unexplainedShare = 0.2;   ///< of the excess, left beside names [prototype]
    double clearlyLeft = 4;          ///< error: where so much is left, a smaller share is too much [case]
    double clearlyLeftShare = 0.04;  ///< of the excess [case]
    double muchLeft = 25;  ///< error, five noise floors: too much whatever the share. Beside a large error that of
                           ///< a wrong name is a small one [case]
    /// Of what is left, a share that a learned curve takes (and a paired test sees): noise has no shape. In 763 cases
    /// of two blind trials (seeds 20261165 and 20261168) named effects left such a curve five times. It took 46 to
    /// 100 %; four of the names were wrong (two for effects outside the library), and in one the truth stood among
    /// their rivals.
    double shapeLeft = 0.4;
    double partlyLeft = 0.5;        ///< of the excess, that names may leave where no law was found beside them [hand]
    double leastMotion = 10;        ///< noise floors that something must move [hand]
    double calibrationT = 2.5;      ///< paired: calibration helps [prototype]
    double calibrationGain = 0.02;  ///< and takes so much, of the error as given and at all [hand]
    double colour = 0.1;            ///< correlation of successive samples of the rest that is no noise [hand]
    double colourErrors = 4;        ///< and standard errors of it, 1/√n each (Anderson 1942) [statistics]
    double unseenWorse = 1.05;  ///< error (RMS) of recordings that no fit saw, over the one before: it got worse [hand]
    double strongCorrelation = 0.98;  ///< of two numbers that the recordings hardly separate [hand]
    double atBound = 1e-3;            ///< of its range, or of itself if that is less: a number is at its
                                      ///< bound [numeric]
    /// share of a recording's samples: may itself be what the simulator does not show [hand]
    double manyMissing = 0.05;
  };

  /// Shifts in time of less than half a step, which are no physics (alignment.h).
  struct Shift {
    double ofTaken = 0.2;  ///< of what a shift takes, less is no physics: what else such an integration is wrong by;
                           ///< arms of six and three joints: a twentieth and a seventh [case]
    double leastTaken = 0.05;  ///< noise floors² that a shift takes that matters [hand]
    double inside = 0.95;      ///< of half a step: farther it may stand for something else [hand]
  };

  /// Where a model leaves so much that nothing explains, costs are mostly of that: what costs twice as much is no other
  /// end of its valley, and the race of candidates ends sooner. Chosen by hand on a real servo (50 noise floors left).
  struct ShortRace {
    double muchLeft = 25;    ///< error from which it is run, as verdict.muchLeft [time]
    double hopeless = 2;     ///< instead of screening.hopeless, and of screening.inReach beside the final model [time]
    double worthMore = 1.1;  ///< instead of confirmation.worthMore [time]
    std::size_t handedTo = 4;  ///< instead of rivals.handedTo [time]
    int wayIterations = 8;     ///< instead of rivals.wayIterations [time]
    double valley = 1.7;       ///< instead of rivals.valley [time]
    double valleyEnd = 1.4;    ///< instead of rivals.valleyEnd [time]
    int iterations = 10;       ///< of what arrives there; what is not within valleyEnd then is fitted no more [time]
    double formRatio = 1.3;    ///< instead of rivals.formRatio [time]

    bool isRun(double error) const { return error > muchLeft; }
  };

  Step step;
  Shift shift;
  Calibration calibration;
  Restarts restarts;
  WholeNumbers wholeNumbers;
  DrawnEffects drawnEffects;
  Candidates candidates;
  Screening screening;
  Confirmation confirmation;
  Refinement refinement;
  Merging merging;
  Rivals rivals;
  ShortRace shortRace;
  Location location;
  SelfExcitation selfExcitation;
  Remainder remainder;
  Law law;
  Trials trials;
  NextRecording nextRecording;
  Verdict verdict;
};

}  // namespace btr
