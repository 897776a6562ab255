/// Policy gradient of Kohl and Stone (ICRA 2004): t policies around π, each parameter changed by +ε, 0 or −ε; the mean
/// fitness of the three groups of each parameter gives a direction, and π moves η steps of ε along it.
///
///   repeat  draw R_1 … R_t around π;  evaluate
///           A_n ← 0 if unchanged was better than both, else Avg(+ε_n) − Avg(−ε_n)
///           π_n ← π_n + η·ε_n·A_n/|A|, within the bounds
///
/// The paper has t = 15 and η = 2; η = 1 gains more in our checks (core/learn/policy_gradient.h has the arithmetic).
/// Where a search begins at the defaults of what it searches (L1 without a start), nothing nearby may be worth more
/// than anything else: a kick that does not reach the ball. While all policies of an iteration are worth the same, they
/// are drawn twice as far out the next time, at most half a range; the first that is worth more than that is where π
/// goes, and ε is itself again. A search that was given a place to begin at (beginAt: L2, L3) never does that.
///
/// Not monotone: π may lose what it had; `measure_centre` evaluates π itself along with the policies around it.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/plugin/plugin.h"

namespace {

class PolicyGradientLearner final : public btr::Learner {
 public:
  std::vector<btr::Parameter> settings() const override {
    return {{"policies", "", "policies of an iteration", 3, 1000, 15, {}, true},
            {"step", "", "length of an iteration's step in units of epsilon; 2 in the paper", 0.01, 100, 1},
            {"epsilon", "", "change of a parameter, as a share of its range", 0.0001, largestShare, defaultShare},
            {"measure_centre", "", "evaluate the centre itself too", 0, 1, 0, {}, false, {"no", "yes"}}};
  }

  std::vector<btr::Parameter> settingsFor(std::span<const btr::Parameter> genotype) const override {
    std::vector<btr::Parameter> declared = settings();
    for (const btr::Parameter& p : genotype)
      declared.push_back({"epsilon_" + p.name, p.unit,
                          "change of " + p.name + "; while it is not set, or 0, the share `epsilon` of its range", 0,
                          p.maximum - p.minimum, defaultShare * (p.maximum - p.minimum)});
    return declared;
  }

  void start(std::vector<btr::Parameter> genotype, const btr::Values& values, btr::Random&) override {
    if (genotype.empty()) throw btr::InputError("pgrl", "a genotype without parameters", "at least one parameter");
    const auto value = btr::resolve(settingsFor(genotype), values, "pgrl");
    policies_ = static_cast<int>(value[0]);
    step_ = value[1];
    measureCentre_ = value[3] == 1;
    genotype_ = std::move(genotype);
    epsilons_.clear();
    centre_.clear();
    for (std::size_t n = 0; n < genotype_.size(); ++n) {
      const btr::Parameter& p = genotype_[n];
      const double own = values.contains("epsilon_" + p.name) ? value[4 + n] : 0;
      double epsilon = own > 0 ? own : value[2] * (p.maximum - p.minimum);
      if (p.integer || !p.choices.empty()) epsilon = std::max(1.0, std::round(epsilon));
      epsilons_.push_back(epsilon);
      centre_.push_back(p.byDefault);
    }
    asked_.clear();
    iteration_ = 1;
    wider_ = 1;
    plateau_.reset();
    explores_ = true;
  }

  void beginAt(std::span<const double> at, const btr::Permutations&, btr::Random&) override {
    explores_ = false;
    centre_ = btr::feasible(genotype_, at);
  }

  std::vector<btr::Candidate> ask(btr::Random& random) override {
    if (asked_.empty()) asked_ = btr::drawPolicies(genotype_, centre_, widened(), policies_, random);
    std::vector<btr::Candidate> candidates;
    for (const auto& policy : asked_) candidates.push_back({"", policy});
    if (measureCentre_) candidates.push_back({"", centre()});
    return candidates;
  }

  void tell(std::span<const double> fitness) override {
    const std::size_t expected = asked_.size() + (measureCentre_ ? 1 : 0);
    if (asked_.empty() || fitness.size() != expected)
      throw btr::InputError("pgrl", std::to_string(fitness.size()) + " fitness values",
                            "one for each of the " + std::to_string(expected) + " policies that were asked for");
    const std::span<const double> worth = fitness.first(asked_.size());
    if (!explores_ || !leavePlateau(worth))
      centre_ = btr::policyGradient(genotype_, centre_, epsilons_, step_, asked_, worth).centre;
    asked_.clear();
    ++iteration_;
  }

  std::vector<double> centre() const override { return btr::feasible(genotype_, centre_); }

  std::string state() const override {
    nlohmann::json state{{"iteration", iteration_}, {"centre", centre_}, {"asked", asked_}};
    if (!explores_) return state.dump();
    state["wider"] = wider_;
    if (plateau_) state["plateau"] = *plateau_;
    return state.dump();
  }

  void setState(const std::string& state) override {
    try {
      const auto document = nlohmann::json::parse(state);
      const auto iteration = document.at("iteration").get<long>();
      auto centre = document.at("centre").get<std::vector<double>>();
      auto asked = document.at("asked").get<std::vector<std::vector<double>>>();
      bool good =
          iteration >= 1 && fits(centre) && (asked.empty() || asked.size() == static_cast<std::size_t>(policies_));
      for (const auto& policy : asked) good = good && fits(policy);
      if (!good) throw btr::InputError("pgrl: the stored state does not belong to a search with these settings");
      // States that were stored before plateaus were left have none of this: they go on as they began.
      explores_ = document.contains("wider");
      wider_ = document.value("wider", 1.0);
      plateau_.reset();
      if (document.contains("plateau")) plateau_ = document.at("plateau").get<double>();
      iteration_ = iteration;
      centre_ = std::move(centre);
      asked_ = std::move(asked);
    } catch (const nlohmann::json::exception& error) {
      throw btr::InputError(std::string("pgrl: the stored state is damaged: ") + error.what());
    }
  }

 private:
  static constexpr double defaultShare = 0.05, largestShare = 0.5;

  std::vector<double> widened() const {
    std::vector<double> all = epsilons_;
    for (std::size_t n = 0; n < all.size() && wider_ > 1; ++n)
      all[n] =
          std::max(all[n], std::min(all[n] * wider_, largestShare * (genotype_[n].maximum - genotype_[n].minimum)));
    return all;
  }

  /// True where all are worth the same, or were until now: then there is no gradient to follow.
  bool leavePlateau(std::span<const double> worth) {
    std::size_t best = 0;
    bool isFlat = true;
    for (std::size_t i = 1; i < worth.size(); ++i) {
      isFlat = isFlat && worth[i] == worth[0];
      if (worth[i] > worth[best]) best = i;
    }
    if (isFlat && (!plateau_ || worth[0] <= *plateau_)) {
      plateau_ = worth[0];
      wider_ = std::min(2 * wider_, largestShare / 0.0001);
      return true;
    }
    if (!plateau_) return false;
    if (worth[best] > *plateau_) {
      centre_ = asked_[best];
      plateau_.reset();
      wider_ = 1;
    }
    return true;
  }

  bool fits(const std::vector<double>& vector) const {
    bool good = vector.size() == genotype_.size();
    for (std::size_t n = 0; good && n < vector.size(); ++n)
      good = vector[n] >= genotype_[n].minimum && vector[n] <= genotype_[n].maximum;
    return good;
  }

  std::vector<btr::Parameter> genotype_;
  std::vector<double> epsilons_;
  int policies_ = 0;
  double step_ = 0;
  bool measureCentre_ = false;
  long iteration_ = 1;
  std::vector<double> centre_;              ///< π; whole parameters are rounded only where it is evaluated
  bool explores_ = true;                    ///< it begins at the defaults and may have to look around
  double wider_ = 1;                        ///< how much further out than ε policies are drawn
  std::optional<double> plateau_;           ///< what everything nearby is worth, while nothing is worth more
  std::vector<std::vector<double>> asked_;  ///< policies that wait for their fitness
};

}  // namespace

BTR_LEARNER(PolicyGradientLearner, "pgrl")
