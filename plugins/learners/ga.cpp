/// Genetic algorithm of the UCHILSIM papers: bit strings, fitness-proportionate selection (roulette) with linear
/// scaling, no elitism, two-point crossover on the whole string, mutation of single bits. Goldberg 1989.
///
///   population ← random bits
///   repeat  evaluate;  copies ← linear scaling of the fitness
///           until the next population is full:
///             two parents ← roulette(copies);  with probability Pc exchange the bits between two cuts
///             each bit flips with probability Pm;  both children join (the second of an odd last pair does not)
///
/// Where a fitness is not finite it counts as the worst finite one; negative fitness is shifted; a converged population
/// selects uniformly.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin.h"

namespace {

using btr::BitCoding;

class GeneticAlgorithm final : public btr::Learner {
 public:
  std::vector<btr::Parameter> settings() const override {
    return {{"population", "", "individuals of a generation", 2, 10000, 30, {}, true},
            {"crossover", "", "probability that a pair of parents exchanges bits", 0, 1, 0.75},
            {"mutation", "", "probability that a bit flips", 0, 1, 0.015},
            {"bits", "", "bits of each parameter", 4, 16, 8, {}, true},
            {"coding", "", "how bits make a number", 0, 1, 0, {}, false, {"binary", "gray"}},
            {"scaling", "", "expected copies of the best, average = 1", 1.2, 2, 2}};
  }

  void start(std::vector<btr::Parameter> genotype, const btr::Values& values, btr::Random& random) override {
    const auto declared = settings();
    const auto value = btr::resolve(declared, values, "ga");
    if (genotype.empty()) throw btr::InputError("ga", "a genotype without parameters", "at least one parameter");
    crossover_ = value[1];
    mutation_ = value[2];
    coding_ = BitCoding(std::move(genotype), static_cast<int>(value[3]),
                        value[4] == 1 ? BitCoding::Kind::gray : BitCoding::Kind::binary);
    scaling_ = value[5];
    population_.assign(static_cast<std::size_t>(value[0]), "");
    for (std::string& chromosome : population_) chromosome = coding_.draw(random);
    fitness_.clear();
    generation_ = 1;
  }

  void beginAt(std::span<const double> at, const btr::Permutations& permutations, btr::Random& random) override {
    const std::string origin = coding_.encode(at);
    const double copies = std::ceil(permutations.share * static_cast<double>(population_.size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(copies); ++i) {
      population_[i] = origin;
      if (i > 0) btr::mutate(population_[i], permutations.flip, random);
    }
  }

  std::vector<btr::Candidate> ask(btr::Random& random) override {
    if (!fitness_.empty()) breed(random);
    std::vector<btr::Candidate> candidates;
    for (const std::string& chromosome : population_) candidates.push_back({chromosome, coding_.decode(chromosome)});
    return candidates;
  }

  void tell(std::span<const double> fitness) override {
    if (fitness.size() != population_.size())
      throw btr::InputError("ga", std::to_string(fitness.size()) + " fitness values",
                            "one for each of the " + std::to_string(population_.size()) + " individuals");
    fitness_ = btr::finiteFitness(fitness);
  }

  std::string state() const override {
    return nlohmann::json{{"generation", generation_}, {"population", population_}, {"fitness", fitness_}}.dump();
  }

  void setState(const std::string& state) override {
    try {
      const auto document = nlohmann::json::parse(state);
      const auto generation = document.at("generation").get<long>();
      auto population = document.at("population").get<std::vector<std::string>>();
      auto fitness = document.at("fitness").get<std::vector<double>>();
      bool good = generation >= 1 && population.size() == population_.size() &&
                  (fitness.empty() || fitness.size() == population.size());
      for (const std::string& chromosome : population) good = good && coding_.fits(chromosome);
      if (!good) throw btr::InputError("ga: the stored state does not belong to a search with these settings");
      generation_ = generation;
      population_ = std::move(population);
      fitness_ = std::move(fitness);
    } catch (const nlohmann::json::exception& error) {
      throw btr::InputError(std::string("ga: the stored state is damaged: ") + error.what());
    }
  }

 private:
  void breed(btr::Random& random) {
    const btr::Roulette wheel(btr::linearScaling(fitness_, scaling_));
    std::vector<std::string> next;
    while (next.size() < population_.size()) {
      std::string one = population_[wheel.spin(random)];
      std::string other = population_[wheel.spin(random)];
      if (random.chance(crossover_)) btr::exchange(one, other, btr::drawCuts(coding_.length(), random));
      btr::mutate(one, mutation_, random);
      btr::mutate(other, mutation_, random);
      next.push_back(std::move(one));
      if (next.size() < population_.size()) next.push_back(std::move(other));
    }
    population_ = std::move(next);
    fitness_.clear();
    ++generation_;
  }

  BitCoding coding_;
  double crossover_ = 0, mutation_ = 0, scaling_ = 0;
  long generation_ = 1;
  std::vector<std::string> population_;
  std::vector<double> fitness_;  ///< of the population; empty until it was told
};

}  // namespace

BTR_LEARNER(GeneticAlgorithm, "ga")
