/// Random search with a memory: each generation holds the best vector so far and normal steps around it,
///   x = best + σ·range·N(0, 1), clamped to the bounds; the first generation is drawn uniformly.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin.h"

namespace {

class RandomSearch final : public btr::Learner {
  std::vector<btr::Parameter> settings() const override {
    return {{"population", "", "vectors of a generation", 2, 10000, 10, {}, true},
            {"sigma", "", "step, as a share of each parameter's range", 0.001, 1, 0.1}};
  }

  void start(std::vector<btr::Parameter> genotype, const btr::Values& values, btr::Random& random) override {
    const std::vector<double> value = btr::resolve(settings(), values, "random_search");
    genotype_ = std::move(genotype);
    sigma_ = value[1];
    population_.assign(static_cast<std::size_t>(value[0]), {});
    for (auto& vector : population_)
      for (const btr::Parameter& p : genotype_) vector.push_back(random.uniform(p.minimum, p.maximum));
    best_.clear();
    told_ = false;
  }

  void beginAt(std::span<const double> at, const btr::Permutations&, btr::Random& random) override {
    best_.assign(at.begin(), at.end());
    draw(random);
  }

  std::vector<btr::Candidate> ask(btr::Random& random) override {
    if (told_) draw(random);
    std::vector<btr::Candidate> candidates;
    for (const auto& vector : population_) candidates.push_back({"", vector});
    return candidates;
  }

  void tell(std::span<const double> fitness) override {
    const std::vector<double> known = btr::finiteFitness(fitness);
    const auto best = std::max_element(known.begin(), known.end());
    best_ = population_[static_cast<std::size_t>(best - known.begin())];
    told_ = true;
  }

  std::vector<double> centre() const override { return best_; }

  std::string state() const override {
    return nlohmann::json{{"population", population_}, {"best", best_}, {"told", told_}}.dump();
  }

  void setState(const std::string& state) override {
    const auto document = nlohmann::json::parse(state);
    population_ = document.at("population").get<std::vector<std::vector<double>>>();
    best_ = document.at("best").get<std::vector<double>>();
    told_ = document.at("told").get<bool>();
  }

 private:
  /// The best one again, and steps around it.
  void draw(btr::Random& random) {
    for (auto& vector : population_) vector = best_;
    for (std::size_t i = 1; i < population_.size(); ++i)
      for (std::size_t k = 0; k < genotype_.size(); ++k) {
        const btr::Parameter& p = genotype_[k];
        const double step = sigma_ * (p.maximum - p.minimum) * random.normal();
        population_[i][k] = std::clamp(population_[i][k] + step, p.minimum, p.maximum);
      }
    told_ = false;
  }

  std::vector<btr::Parameter> genotype_;
  double sigma_ = 0.1;
  std::vector<std::vector<double>> population_;
  std::vector<double> best_;
  bool told_ = false;
};

}  // namespace

BTR_LEARNER(RandomSearch, "random_search")
