#pragma once
#include <string>
#include <vector>

#include "core/openr/builder/compiler_complaints.h"

namespace btr::openr {

/// What the robot's compiler had beyond C++ and compilers since then refuse, written as they want it, for those of
/// `complaints` that are about it:
/// - a cast that is assigned to or counted up, `((byte*)p)++`;
/// - __FUNCTION__ between literals, `"in " __FUNCTION__`;
/// - the lesser and the greater of two, `a <? b`, `a >?= b`, see btr_old_operators.h.
/// `bare` is `preprocessed` without its literals, `begins` the places of its lines.
void addOldExtensions(const std::string& preprocessed, const std::string& bare,
                      const std::map<Place, std::size_t>& begins, const std::vector<Complaint>& complaints,
                      Changes& changes);

}  // namespace btr::openr
