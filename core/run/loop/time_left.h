#pragma once

namespace btr {

/// What a run simulates until its last generation, in trials, as far as its settings say it. Measuring, gap analyses
/// and what L2 tries in a simulator are not counted.
struct PlannedWork {
  int learnersPopulation = 0, adaptersPopulation = 0;  ///< trials of a generation of L1; candidates of one of L3
  int firstGenerations = 1, nextGenerations = 1, totalGenerations = 1;  ///< of L1, see stageParameters()
  int adaptersGenerations = 0;                                          ///< of L3 at each stage
  int shownIndividuals = 0;  ///< of each stage, by which L3 judges a candidate from then on

  /// L1 generation after which stage k = 1, 2, … measures, at most the total.
  int measuredAfter(int stage) const;
  /// Stages of measuring and L3 until the run is finished.
  int stages() const;
  /// A generation of L3 after stage 1, 2, …: each candidate is tried on all that was measured until then.
  double trialsOfAdaptersGeneration(int stage) const;
  /// With `learned` generations of L1 and, of stage 1, 2, …, which is being worked on, `adapted` generations of L3.
  double trialsLeft(int learned, int stage, int adapted) const;
};

}  // namespace btr
