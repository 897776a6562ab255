#include "tests/bench/engine_tasks.h"

#include <algorithm>
#include <cmath>

#include "core/spec/gait_spec.h"
#include "core/spec/random.h"

namespace btr::bench {
namespace {

constexpr double mutation = 0.05;  ///< of a gene's range

double withinGene(double value, const Parameter& gene) {
  const double within = std::clamp(value, gene.minimum, gene.maximum);
  return gene.integer ? std::round(within) : within;
}

std::vector<double> mutant(const std::vector<double>& parent, const std::vector<Parameter>& genes, Random& random) {
  std::vector<double> child = parent;
  for (std::size_t i = 0; i < child.size(); ++i) {
    const double range = genes[i].maximum - genes[i].minimum;
    child[i] = withinGene(child[i] + mutation * range * random.normal(), genes[i]);
  }
  return child;
}

std::vector<double> drawn(const std::vector<Parameter>& genes, Random& random) {
  std::vector<double> genotype;
  for (const Parameter& gene : genes) genotype.push_back(withinGene(random.uniform(gene.minimum, gene.maximum), gene));
  return genotype;
}

}  // namespace

BenchTask manyKicks(const Controller& kick) {
  const auto spec = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  BenchTask task = kickTask(spec, loadModels(spec), kick);
  const auto genes = kick.genotype();
  Random random(1);
  const std::size_t learned = task.parameters.size();
  for (std::size_t i = 0; i < 15; ++i) task.parameters.push_back(mutant(task.parameters[i % learned], genes, random));
  for (std::size_t i = 0; i < 15; ++i) task.parameters.push_back(drawn(genes, random));
  return task;
}

BenchTask manyWalks(const Controller& halfEllipse) {
  const GaitSpec gait = loadGait(SOURCE_DIR "/resources/gaits/murcia_2007.json");
  const auto spec = loadScene(SOURCE_DIR "/resources/scenes/walk.json");
  BenchTask task = walkTask(spec, loadModels(spec));
  task.controller = &halfEllipse;
  task.settings = gait.controller.settings;
  task.settings["duration_s"] = 4;
  const auto genes = halfEllipse.genotype();
  task.parameters.clear();
  std::vector<double> parent;
  for (const Parameter& gene : genes) parent.push_back(gait.parameters.at(gene.name));
  task.parameters.push_back(parent);
  Random random(1);
  while (task.parameters.size() < 30) task.parameters.push_back(mutant(parent, genes, random));
  halfEllipse.arrange(task.scene, task.settings);
  return task;
}

}  // namespace btr::bench
