#pragma once
#include "core/cluster/parts.h"
#include "core/store/records.h"

namespace btr {

/// What another process needs to prepare a run's experiment as it is here: SPEC SCENE [NAME HASH CONTENT]..., of the
/// models' files.
Parts experimentParts(const RunRecord& record);
/// Of the parts from there on. Throws InputError for what experimentParts() does not give.
RunRecord experimentFrom(Parts::const_iterator begin, Parts::const_iterator end);

}  // namespace btr
