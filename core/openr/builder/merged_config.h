#pragma once
#include <string>

namespace btr::openr {

/// Lists (OBJECT.CFG and the like) as one: lines of the second that the first does not have are added, each below its
/// own [ERS-x].
std::string mergedConfig(const std::string& first, const std::string& second);

}  // namespace btr::openr
