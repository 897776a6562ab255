#pragma once
#include <string>

namespace btr::openr {

/// The line `object NAME STACK HEAP PRIORITY cache tlb user` of an .ocf; "" if there is none. Throws InputError with
/// file, line, value and what is allowed where there is anything else than it, comments (# or //) and blank lines.
std::string objectLineOf(const std::string& ocf, const std::string& file);

}  // namespace btr::openr
