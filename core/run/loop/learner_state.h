#pragma once
#include "core/learn/learner.h"
#include "core/spec/random.h"

namespace btr {

// A search goes on with the same bits from what is stored with its latest step: of L1 a GenerationRecord, of L2 a
// RealityIteration, of L3 an AdaptationRecord.

template <class Record>
void keepState(Record& record, const Random& random, const Learner& learner) {
  record.randomState = random.state();
  record.learnerState = learner.state();
}

/// The learner was started before, with the same settings.
template <class Record>
void goOnFrom(const Record& record, Random& random, Learner& learner) {
  random.setState(record.randomState);
  learner.setState(record.learnerState);
}

}  // namespace btr
