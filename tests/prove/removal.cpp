#include "tests/prove/removal.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/linearise.h"
#include "core/sim/effect.h"
#include "tests/prove/reality.h"

namespace btr::prove {
namespace {

using Samples = std::vector<double>;

Samples oneTrial(const BlindWorld& world, const Scene& scene, const TrialPlan& plan) {
  const Truth truth = simulateOde(scene, plan, world.columns);
  if (!truth.fault.empty()) return {};
  Samples samples;
  for (std::size_t i = 0; i < world.columns.size(); ++i) {
    const double unit = 1 / world.columns[i].floor();
    for (const double value : truth.values[i]) samples.push_back(value * unit);
  }
  return samples;
}

/// A number that a fit may change.
struct Unknown {
  enum class Of { path, effect, startPosition, startVelocity };
  Of of = Of::path;
  std::string name;       ///< path or parameter
  std::size_t index = 0;  ///< effect or trial
  int axis = 0;
  double low = 0, high = 0, step = 0;
};

/// The simulator with its unknowns put in; trials are simulated one by one.
class Fit {
 public:
  Fit(const BlindWorld& world, const SimulatorSpec& simulator, const EffectFactory& effects,
      const std::vector<Samples>& recorded, int whole)
      : world_(world), simulator_(simulator), effects_(effects), recorded_(recorded) {
    addPaths();
    for (std::size_t i = 0; i < simulator.effects.size(); ++i) addEffect(i, static_cast<int>(i) == whole);
    for (std::size_t trial = 0; trial < world.trials.size() && !world.scene.balls.empty(); ++trial) addStart(trial);
  }

  /// From the values given; where bounces are fitted, also from others: between them error is no valley but steps.
  double best(int steps) {
    const auto given = values_;
    double least = descended(steps);
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      if (unknowns_[i].of == Unknown::Of::path && unknowns_[i].name == "floor.restitution")
        for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
          values_ = given;
          values_[i] = unknowns_[i].low + share * (unknowns_[i].high - unknowns_[i].low);
          least = std::min(least, descended(steps));
        }
    return least;
  }

 private:
  double descended(int steps) {
    double error = evaluate(values_, residual_);
    double damping = 1e-3;
    for (int step = 0; step < steps && std::isfinite(error) && !unknowns_.empty(); ++step) {
      const double before = error;
      linearise();
      for (int attempt = 0; attempt < 4; ++attempt) {
        std::vector<Samples> residual;
        const auto tried = move(damping);
        const double now = evaluate(tried, residual);
        if (now < error) {
          error = now;
          values_ = tried;
          residual_ = std::move(residual);
          damping /= 10;
          break;
        }
        damping *= 10;
      }
      if (error > before * (1 - 1e-3)) break;
    }
    return error;
  }

  void add(Unknown unknown, double value) {
    unknowns_.push_back(unknown);
    values_.push_back(value);
  }

  void addPaths() {
    // Feet that slip and stick need larger steps than smooth motions.
    const double share = world_.scene.floor && !world_.scene.robots.empty() ? 0.03 : 1e-3;
    for (const auto& path : world_.scene.calibrate) {
      const double value = simulator_.values.at(path.path);
      add({Unknown::Of::path, path.path, 0, 0, path.minimum, path.maximum, share * std::abs(value)}, value);
    }
  }

  void addEffect(std::size_t index, bool whole) {
    const PlacedEffect& placed = simulator_.effects[index];
    for (const Parameter& parameter : effects_(placed.effect)->parameters()) {
      const double value = placed.parameters.at(parameter.name);
      // A size that is neutral stays so; a shape (where a spring rests, how fast friction fades) may take up what is
      // left out elsewhere.
      if (!whole && parameter.neutral && value == *parameter.neutral) continue;
      if (parameter.integer || !parameter.choices.empty()) continue;
      const double span = parameter.maximum - parameter.minimum;
      add({Unknown::Of::effect, parameter.name, index, 0, parameter.minimum, parameter.maximum,
           std::max(1e-3 * std::abs(value), 1e-5 * span)},
          value);
    }
  }

  void addStart(std::size_t trial) {
    const bool flies = world_.trials[trial].settle_s == 0;
    for (int axis = 0; axis < (flies ? 3 : 2); ++axis) {
      const double p = world_.trials[trial].ball.position_m[axis], v = world_.trials[trial].ball.velocity_m_s[axis];
      add({Unknown::Of::startPosition, "", trial, axis, p - 0.1, p + 0.1, 1e-4}, p);
      add({Unknown::Of::startVelocity, "", trial, axis, v - 1, v + 1, 1e-3}, v);
    }
  }

  bool ofTrial(std::size_t unknown) const {
    return unknowns_[unknown].of == Unknown::Of::startPosition || unknowns_[unknown].of == Unknown::Of::startVelocity;
  }

  Scene sceneOf(const std::vector<double>& values) const {
    SimulatorSpec simulator = simulator_;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (unknowns_[i].of == Unknown::Of::path) simulator.values[unknowns_[i].name] = values[i];
      if (unknowns_[i].of == Unknown::Of::effect)
        simulator.effects[unknowns_[i].index].parameters[unknowns_[i].name] = values[i];
    }
    return makeScene(world_.scene, world_.models, simulator, effects_);
  }

  Samples residualOf(const Scene& scene, const std::vector<double>& values, std::size_t trial) const {
    TrialPlan plan = world_.trials[trial];
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (!ofTrial(i) || unknowns_[i].index != trial) continue;
      (unknowns_[i].of == Unknown::Of::startPosition ? plan.ball.position_m
                                                     : plan.ball.velocity_m_s)[unknowns_[i].axis] = values[i];
    }
    if (!scene.balls.empty() && plan.settle_s > 0)
      plan.ball.spin_rad_s = Eigen::Vector3d::UnitZ().cross(plan.ball.velocity_m_s) / plan.ball.radius_m;
    Samples samples = oneTrial(world_, scene, plan);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] -= recorded_[trial][i];
    return samples;
  }

  double evaluate(const std::vector<double>& values, std::vector<Samples>& residual) const {
    const Scene scene = sceneOf(values);
    residual.clear();
    double sum = 0, count = 0;
    for (std::size_t trial = 0; trial < world_.trials.size(); ++trial) {
      residual.push_back(residualOf(scene, values, trial));
      if (residual.back().empty()) return std::numeric_limits<double>::infinity();
      for (const double r : residual.back()) sum += r * r;
      count += static_cast<double>(residual.back().size());
    }
    return std::sqrt(sum / count);
  }

  /// Normal equations from forward differences.
  void linearise() {
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    normal_ = Eigen::MatrixXd::Zero(n, n);
    gradient_ = Eigen::VectorXd::Zero(n);
    std::vector<std::vector<Samples>> moved(unknowns_.size());
    const Scene here = sceneOf(values_);
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      auto values = values_;
      const double step = values[i] + unknowns_[i].step <= unknowns_[i].high ? unknowns_[i].step : -unknowns_[i].step;
      values[i] += step;
      const Scene scene = ofTrial(i) ? here : sceneOf(values);
      for (std::size_t trial = 0; trial < world_.trials.size(); ++trial) {
        if (ofTrial(i) && unknowns_[i].index != trial) {
          moved[i].emplace_back();
          continue;
        }
        moved[i].push_back(residualOf(scene, values, trial));
        auto& column = moved[i].back();
        for (std::size_t k = 0; k < column.size(); ++k) column[k] = (column[k] - residual_[trial][k]) / step;
      }
    }
    for (std::size_t trial = 0; trial < world_.trials.size(); ++trial)
      for (std::size_t i = 0; i < unknowns_.size(); ++i) {
        const Samples& a = moved[i][trial];
        if (a.empty()) continue;
        gradient_[static_cast<Eigen::Index>(i)] += dot(a, residual_[trial]);
        for (std::size_t j = 0; j <= i; ++j)
          if (!moved[j][trial].empty())
            normal_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += dot(a, moved[j][trial]);
      }
    normal_ = Eigen::MatrixXd(normal_.selfadjointView<Eigen::Lower>());
  }

  static double dot(const Samples& a, const Samples& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  std::vector<double> move(double damping) const {
    Eigen::MatrixXd damped = normal_;
    for (Eigen::Index i = 0; i < damped.rows(); ++i) damped(i, i) += damping * normal_(i, i) + 1e-12;
    const Eigen::VectorXd step = damped.ldlt().solve(gradient_);
    auto values = values_;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::clamp(values[i] - step[static_cast<Eigen::Index>(i)], unknowns_[i].low, unknowns_[i].high);
    return values;
  }

  const BlindWorld& world_;
  const SimulatorSpec& simulator_;
  const EffectFactory& effects_;
  const std::vector<Samples>& recorded_;
  std::vector<Unknown> unknowns_;
  std::vector<double> values_;
  std::vector<Samples> residual_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
};

}  // namespace

std::vector<Samples> noiseless(const BlindWorld& world, const SimulatorSpec& simulator, const EffectFactory& effects) {
  const Scene scene = makeScene(world.scene, world.models, simulator, effects);
  std::vector<Samples> all;
  for (const TrialPlan& plan : world.trials) {
    all.push_back(oneTrial(world, scene, plan));
    if (all.back().empty()) return {};
  }
  return all;
}

double difference(const std::vector<Samples>& a, const std::vector<Samples>& b) {
  if (a.empty() || b.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0, count = 0;
  for (std::size_t trial = 0; trial < a.size(); ++trial)
    for (std::size_t i = 0; i < a[trial].size(); ++i) {
      sum += std::pow(a[trial][i] - b[trial][i], 2);
      count += 1;
    }
  return std::sqrt(sum / count);
}

double leftAfterRefit(const BlindWorld& world, const SimulatorSpec& simulator, const EffectFactory& effects,
                      const std::vector<Samples>& recorded, int whole) {
  constexpr int steps = 25;  // most stop earlier, at a gain below a thousandth
  return Fit(world, simulator, effects, recorded, whole).best(steps);
}

}  // namespace btr::prove
