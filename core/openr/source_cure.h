#pragma once
#include <string>

namespace btr::openr {

/// Preprocessed source without the parameter names that stand twice in a declaration, which compilers of 2003 let pass:
/// those that lines "FILE:LINE:COLUMN: error: redefinition of 'TYPE NAME'" of `errors` name.
std::string withoutRepeatedNames(const std::string& preprocessed, const std::string& errors);

}  // namespace btr::openr
