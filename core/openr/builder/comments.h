#pragma once
#include <string>

namespace btr::openr {

/// A stub.cfg or an .ocf without its comments: behind # or //, and between /* and */. Its lines keep their numbers.
std::string withoutComments(const std::string& text);

}  // namespace btr::openr
