// Which curve of which quantity would take up what is left: linear, by sensitivities.
#include "core/gap/search/laws/law_screen.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/gap/fit/parallel.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/replay/followed_torques.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// What a joint did in the recordings.
struct JointSeen {
  std::string at;
  double scale = 1;  ///< a typical force
  bool isDriven = false, turns = false;
  double strength = 1;  ///< of its drive
  Extent position, speed, time;
  double excess = 0;  ///< sum of squared residuals of its own channels
};

std::vector<JointSeen> jointsSeen(const FitProblem& problem, const Scene& scene, const Eigen::VectorXd& residuals,
                                  double ofStrength) {
  std::vector<JointSeen> joints;
  const auto seen = [&](std::size_t robot, std::size_t joint) -> JointSeen& {
    const SceneRobot& owner = scene.robots[robot];
    const std::string at = owner.name + "." + owner.model.joints[joint].name;
    for (JointSeen& each : joints)
      if (each.at == at) return each;
    const Drive& drive = owner.drives[joint];
    JointSeen fresh;
    fresh.at = at;
    constexpr double unlimited = 1e8, gainAsStrength = 0.1;  // a torque limit that is none; rad of a servo's error
    fresh.strength = drive.maxTorque < unlimited ? drive.maxTorque : drive.p > 0 ? drive.p * gainAsStrength : 1;
    fresh.scale = ofStrength * fresh.strength;
    fresh.isDriven = drive.kind != Drive::Kind::none && drive.kind != Drive::Kind::motion;
    fresh.turns = owner.model.joints[joint].type != Joint::Type::slide;
    joints.push_back(fresh);
    return joints.back();
  };
  const auto addPath = [](JointSeen& joint, const FitTrial& trial, std::size_t which) {
    const auto& column = trial.recording.columns[which];
    const auto& t = trial.recording.columns[0];
    constexpr std::size_t apart = 4;  // samples of a slope: noise counts less
    for (std::size_t row = 0; row < trial.rows(); ++row) {
      joint.position.add(column[row]);
      joint.time.add(t[row] - t[0]);
      if (row >= apart) joint.speed.add((column[row] - column[row - apart]) / (t[row] - t[row - apart]));
    }
  };
  for (const FitTrial& trial : problem.trials) {
    for (const auto& measured : trial.binding.measured)
      if (measured.what == Measured::What::position)
        addPath(seen(measured.object, measured.part), trial, measured.column);
    // Where the motion is prescribed, it is the torque that is compared.
    for (const auto& input : trial.binding.inputs)
      if (input.what == Binding::Input::What::motion) addPath(seen(input.robot, input.joint), trial, input.column);
    for (const std::size_t channel : followedTorques(trial.binding)) {
      const Measured& torque = trial.binding.measured[channel];
      Extent range;
      range.add(trial.recording.columns[torque.column]);
      JointSeen& joint = seen(torque.object, torque.part);
      if (range.some())
        joint.scale = std::max(joint.scale, ofStrength * std::max(std::abs(range.low), std::abs(range.high)));
    }
  }
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      const Binding& binding = problem.trials[segment.trial].binding;
      const Measured& measured = binding.measured[segment.channel[k]];
      if (measured.what == Measured::What::position || measured.what == Measured::What::rate ||
          isFollowedTorque(binding, measured))
        seen(measured.object, measured.part).excess += residuals[at] * residuals[at];
    }
  std::erase_if(joints, [](const JointSeen& joint) { return !joint.position.some() || !joint.speed.some(); });
  std::ranges::stable_sort(joints, std::ranges::greater{}, &JointSeen::excess);
  return joints;
}

std::vector<LawTerm> termsOf(const JointSeen& joint, bool overTime, const SearchThresholds::Law& limits) {
  using On = LawTerm::On;
  using Kind = LawTerm::Kind;
  std::vector<LawTerm> terms;
  const auto add = [&](On on, Kind kind, const Extent& range, int knots) {
    terms.push_back({on, kind, range.low, range.high, knots});
  };
  add(On::position, Kind::force, joint.position, limits.firstKnots);
  add(On::velocity, Kind::force, joint.speed, limits.firstKnots);
  if (overTime) add(On::time, Kind::force, joint.time, limits.firstKnots);
  if (joint.isDriven) add(On::load, Kind::force, Extent{-joint.strength, joint.strength}, limits.firstKnots);
  add(On::position, Kind::friction, joint.position, limits.firstKnots);
  if (overTime) add(On::time, Kind::friction, joint.time, limits.firstKnots);
  if (joint.turns && joint.position.high - joint.position.low > limits.turnsForAngle * 2 * M_PI)
    add(On::angle, Kind::force, Extent{0, 2 * M_PI}, limits.firstKnots);
  return terms;
}

/// What one knot changes, per typical force, initial states taken out. `law`: as it is in `fit`, its last term's values
/// 0 where that is not in it yet.
Eigen::VectorXd columnOf(const FitProblem& problem, const FitModel& named, const Fit& fit, const Linearised& linear,
                         const Law& law, int knot) {
  Law moved = law;
  moved.values.back()[static_cast<std::size_t>(knot)] += law.scale;
  // Named effects and numbers stand in `fit` before the law's knots.
  const FitModel model = withNumbersOf(named, fit.model);
  const Eigen::VectorXd residuals = residualsOf(problem, moved.in(problem, model, true), fit.shifts);
  return linear.profile(problem, residuals - linear.residuals);
}

/// Normal equations of one part of the residuals.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  double square = 0;
};

/// Of each residual: the part that is left out together with it, of so many.
struct Parts {
  std::size_t count = 0;
  std::vector<std::size_t> of;
};

Parts partsOf(const FitProblem& problem) {
  constexpr std::size_t enoughTrials = 3, mostParts = 6;
  std::set<std::size_t> trials;
  for (const Segment& segment : problem.segments) trials.insert(segment.trial);
  const bool byTrial = trials.size() >= enoughTrials;
  Parts parts{byTrial ? std::min(trials.size(), mostParts) : 2, {}};
  for (const Segment& segment : problem.segments) {
    const auto order = static_cast<std::size_t>(std::distance(trials.begin(), trials.find(segment.trial)));
    for (const char fold : segment.fold)
      parts.of.push_back(byTrial ? order % parts.count : static_cast<std::size_t>(fold));
  }
  return parts;
}

/// Regression of what is left on columns, of which the last `knots` are a curve that should not be rough.
struct Regression {
  double cost = INFINITY;  ///< squared residuals of parts that were left out
  Eigen::VectorXd values;  ///< in the columns' units
};

Regression regress(const Eigen::MatrixXd& columns, const Eigen::VectorXd& left, int knots, const Parts& parts) {
  const Eigen::Index width = columns.cols();
  std::vector<Normal> normals(parts.count, {Eigen::MatrixXd::Zero(width, width), Eigen::VectorXd::Zero(width), 0});
  for (std::size_t part = 0; part < parts.count; ++part) {
    std::vector<Eigen::Index> rows;
    for (std::size_t k = 0; k < parts.of.size(); ++k)
      if (parts.of[k] == part) rows.push_back(static_cast<Eigen::Index>(k));
    const Eigen::MatrixXd own = columns(rows, Eigen::all);
    const Eigen::VectorXd right = left(rows);
    normals[part] = {own.transpose() * own, own.transpose() * right, right.squaredNorm()};
  }
  Normal all{Eigen::MatrixXd::Zero(width, width), Eigen::VectorXd::Zero(width), 0};
  for (const Normal& normal : normals) {
    all.matrix += normal.matrix;
    all.right += normal.right;
    all.square += normal.square;
  }
  // A price on second differences of the curve, in parts of what its knots change on average.
  Eigen::MatrixXd rough = Eigen::MatrixXd::Zero(width, width);
  for (Eigen::Index i = width - knots; i + 2 < width; ++i) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(width);
    difference[i] = difference[i + 2] = 1;
    difference[i + 1] = -2;
    rough += difference * difference.transpose();
  }
  const double mean = knots > 0 ? all.matrix.diagonal().tail(knots).mean() : 0;
  // Ridge: what nothing is sensitive to stays. [numeric]
  Eigen::MatrixXd ridge = (1e-9 * all.matrix.diagonal().array() + 1e-6 * mean + 1e-12).matrix().asDiagonal();
  Regression best;
  for (const double price : {1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0}) {
    const Eigen::MatrixXd added = price * mean * rough + ridge;
    double cost = 0;
    for (const Normal& normal : normals) {
      const Eigen::VectorXd values = (all.matrix - normal.matrix + added).ldlt().solve(all.right - normal.right);
      cost += normal.square - 2 * values.dot(normal.right) + values.dot(normal.matrix * values);
    }
    if (cost < best.cost) best = {cost, (all.matrix + added).ldlt().solve(all.right)};
    if (knots == 0) break;
  }
  return best;
}

/// Takes the ends of the last term's curve away that the recordings do not reach: no fit knows a value there, and what
/// it made up would be met by a motion that goes farther. Beyond what is left the ends' values hold.
void keepWhatIsReached(Law& law, Eigen::MatrixXd& curve, double reached) {
  LawTerm& term = law.terms.back();
  if (term.on == LawTerm::On::angle) return;  // its ends are one place
  const Eigen::VectorXd seen = curve.colwise().norm();
  const double least = reached * seen.maxCoeff();
  Eigen::Index first = 0, last = seen.size() - 1;
  while (first < last && seen[first] < least) ++first;
  while (last > first && seen[last] < least) --last;
  if (last == first || last - first + 1 == seen.size()) return;
  const double low = term.knot(static_cast<int>(first)), high = term.knot(static_cast<int>(last));
  term.low = low;
  term.high = high;
  term.knots = static_cast<int>(last - first + 1);
  law.values.back().assign(static_cast<std::size_t>(term.knots), 0.0);
  curve = curve.middleCols(first, last - first + 1).eval();
}

/// The law's last term over its knots, with values and share.
LawOption promised(const Linearised& linear, Eigen::MatrixXd curve, Law law, const Parts& parts, double costWithout,
                   double reached) {
  keepWhatIsReached(law, curve, reached);
  Eigen::MatrixXd columns(linear.columns.rows(), linear.columns.cols() + curve.cols());
  columns << linear.columns, curve;
  const Regression found = regress(columns, -linear.profiled, static_cast<int>(curve.cols()), parts);
  LawOption option{law, 1 - found.cost / costWithout};
  for (Eigen::Index i = 0; i < curve.cols(); ++i) {
    double& value = option.law.values.back()[static_cast<std::size_t>(i)];
    value = law.scale * found.values[linear.columns.cols() + i];
    if (law.terms.back().kind == LawTerm::Kind::friction) value = std::max(0.0, value);
  }
  return option;
}

double costWithout(const Linearised& linear, const Parts& parts) {
  return regress(linear.columns, -linear.profiled, 0, parts).cost;
}

/// Columns of all knots of the laws' last terms; an empty matrix where the scene refuses one.
std::vector<Eigen::MatrixXd> columnsOf(const FitProblem& problem, const FitModel& named, const Fit& fit,
                                       const Linearised& linear, const std::vector<Law>& laws, int jobs) {
  struct Knot {
    std::size_t law = 0;
    int index = 0;
  };
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < laws.size(); ++i)
    for (int k = 0; k < laws[i].terms.back().knots; ++k) knots.push_back({i, k});
  FitProblem alone = problem;
  alone.jobs = 1;
  const auto results = parallel(jobs, knots.size(), [&](std::size_t i) {
    const Eigen::VectorXd column = columnOf(alone, named, fit, linear, laws[knots[i].law], knots[i].index);
    return std::vector<double>(column.data(), column.data() + column.size());
  });
  std::vector<Eigen::MatrixXd> columns(laws.size());
  for (std::size_t i = 0; i < laws.size(); ++i)
    columns[i] = Eigen::MatrixXd::Zero(linear.residuals.size(), laws[i].terms.back().knots);
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (results[i].ok())
      columns[knots[i].law].col(knots[i].index) =
          Eigen::Map<const Eigen::VectorXd>(results[i].numbers.data(), linear.residuals.size());
    else
      columns[knots[i].law].setZero();
  return columns;
}

Law withTerm(const Law& there, const JointSeen& joint, const LawTerm& term) {
  Law law = there;
  law.at = joint.at;
  law.scale = joint.scale;
  law.terms.push_back(term);
  law.values.emplace_back(static_cast<std::size_t>(term.knots), 0.0);
  return law;
}

}  // namespace

std::vector<LawOption> screenLaws(const FitProblem& problem, const FitModel& named, const Fit& fit,
                                  const Linearised& linear, const Law& there, int jobs,
                                  const SearchThresholds::Law& thresholds) {
  const Scene scene = problem.sceneOf(fit.model.simulator(problem), 0);
  std::vector<JointSeen> joints = jointsSeen(problem, scene, linear.residuals, thresholds.ofStrength);
  if (!there.terms.empty()) std::erase_if(joints, [&](const JointSeen& joint) { return joint.at != there.at; });
  if (joints.size() > thresholds.joints) joints.resize(thresholds.joints);
  std::vector<Law> laws;
  for (const JointSeen& joint : joints)
    for (const LawTerm& term : termsOf(joint, problem.trials.size() >= thresholds.timeNeedsTrials, thresholds)) {
      const bool known = std::ranges::any_of(
          there.terms, [&](const LawTerm& other) { return other.on == term.on && other.kind == term.kind; });
      if (!known) laws.push_back(withTerm(there, joint, term));
    }
  const std::vector<Eigen::MatrixXd> columns = columnsOf(problem, named, fit, linear, laws, jobs);
  const Parts parts = partsOf(problem);
  const double without = costWithout(linear, parts);
  std::vector<LawOption> options;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    if (columns[i].squaredNorm() <= 0) continue;
    const LawOption option = promised(linear, columns[i], laws[i], parts, without, thresholds.reached);
    if (option.share > thresholds.leastPromise) options.push_back(option);
  }
  std::ranges::stable_sort(options, std::ranges::greater{}, &LawOption::share);
  return options;
}

LawOption refineTerm(const FitProblem& problem, const FitModel& named, const Fit& fit, const Linearised& linear,
                     const Law& there, const LawOption& option, int jobs, const SearchThresholds::Law& thresholds) {
  Law law = there;
  law.at = option.law.at;
  law.scale = option.law.scale;
  LawTerm term = option.law.terms.back();
  term.knots = std::min(thresholds.knots, mostLawKnots);
  law.terms.push_back(term);
  law.values.emplace_back(static_cast<std::size_t>(term.knots), 0.0);
  const std::vector<Eigen::MatrixXd> columns = columnsOf(problem, named, fit, linear, {law}, jobs);
  if (columns[0].squaredNorm() <= 0) return option;
  const Parts parts = partsOf(problem);
  const LawOption finer = promised(linear, columns[0], law, parts, costWithout(linear, parts), thresholds.reached);
  return finer.share > option.share ? finer : option;
}

Law denserLaw(const FitProblem& problem, const FitModel& named, const Fit& fit, const Linearised& linear,
              const Law& law, int jobs, const SearchThresholds::Law& thresholds) {
  const LawTerm coarse = law.terms.back();
  const Scene scene = problem.sceneOf(fit.model.simulator(problem), 0);
  LawTerm term = coarse;
  for (const JointSeen& joint : jointsSeen(problem, scene, linear.residuals, thresholds.ofStrength))
    if (joint.at == law.at)
      for (const LawTerm& whole : termsOf(joint, true, thresholds))
        if (whole.on == term.on && whole.kind == term.kind) term = whole;
  term.knots = std::min({2 * coarse.knots - 1, thresholds.knots, mostLawKnots});
  Law denser = law;
  denser.terms.back() = term;
  const auto takeValues = [&] {
    const LawTerm& now = denser.terms.back();
    denser.values.back().clear();
    for (int i = 0; i < now.knots; ++i)
      denser.values.back().push_back(lawValue(coarse, law.values.back(), now.knot(i)));
  };
  takeValues();
  Eigen::MatrixXd columns = columnsOf(problem, named, fit, linear, {denser}, jobs)[0];
  if (columns.squaredNorm() <= 0) return law;
  keepWhatIsReached(denser, columns, thresholds.reached);
  takeValues();
  return denser;
}

}  // namespace btr
