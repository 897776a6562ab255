/// Policy gradient of Kohl and Stone (ICRA 2004): t policies around π, each parameter changed by +ε, 0 or −ε; the mean
/// fitness of the three groups of each parameter gives a direction, and π moves η steps of ε along it.
///
///   repeat  draw R_1 … R_t around π;  evaluate
///           A_n ← 0 if unchanged was better than both, else Avg(+ε_n) − Avg(−ε_n)
///           π_n ← π_n + η·ε_n·A_n/|A|, within the bounds
///
/// The paper has t = 15 and η = 2; η = 1 gains more in our checks (core/learn/policy_gradient.h has the arithmetic).
/// Not monotone: π may lose what it had; `measure_centre` evaluates π itself along with the policies around it.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin.h"

namespace {

class PolicyGradientLearner final : public btr::Learner {
 public:
  std::vector<btr::Parameter> settings() const override {
    return {{"policies", "", "policies of an iteration", 3, 1000, 15, {}, true},
            {"step", "", "length of an iteration's step in units of epsilon; 2 in the paper", 0.01, 100, 1},
            {"epsilon", "", "change of a parameter, as a share of its range", 0.0001, 0.5, 0.05},
            {"measure_centre", "", "evaluate the centre itself too", 0, 1, 0, {}, false, {"no", "yes"}}};
  }

  std::vector<btr::Parameter> settingsFor(std::span<const btr::Parameter> genotype) const override {
    std::vector<btr::Parameter> declared = settings();
    for (const btr::Parameter& p : genotype)
      declared.push_back({"epsilon_" + p.name, p.unit, "change of " + p.name + "; 0: the share of its range", 0,
                          p.maximum - p.minimum, 0});
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
      const double own = value[4 + n];
      double epsilon = own > 0 ? own : value[2] * (p.maximum - p.minimum);
      if (p.integer || !p.choices.empty()) epsilon = std::max(1.0, std::round(epsilon));
      epsilons_.push_back(epsilon);
      centre_.push_back(p.byDefault);
    }
    asked_.clear();
    iteration_ = 1;
  }

  void beginAt(std::span<const double> at, const btr::Permutations&, btr::Random&) override {
    centre_ = btr::feasible(genotype_, at);
  }

  std::vector<btr::Candidate> ask(btr::Random& random) override {
    if (asked_.empty()) asked_ = btr::drawPolicies(genotype_, centre_, epsilons_, policies_, random);
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
    centre_ = btr::policyGradient(genotype_, centre_, epsilons_, step_, asked_, fitness.first(asked_.size())).centre;
    asked_.clear();
    ++iteration_;
  }

  std::vector<double> centre() const override { return btr::feasible(genotype_, centre_); }

  std::string state() const override {
    return nlohmann::json{{"iteration", iteration_}, {"centre", centre_}, {"asked", asked_}}.dump();
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
      iteration_ = iteration;
      centre_ = std::move(centre);
      asked_ = std::move(asked);
    } catch (const nlohmann::json::exception& error) {
      throw btr::InputError(std::string("pgrl: the stored state is damaged: ") + error.what());
    }
  }

 private:
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
  std::vector<std::vector<double>> asked_;  ///< policies that wait for their fitness
};

}  // namespace

BTR_LEARNER(PolicyGradientLearner, "pgrl")
