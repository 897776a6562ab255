#pragma once
#include <string>

namespace btr::openr {

/// What to do about an object that was not built, by what make and the compiler said: the end of a sentence.
std::string buildHint(const std::string& said);

}  // namespace btr::openr
