#pragma once
#include <string>
#include <vector>

namespace btr::openr {

/// Preprocessed source without the parameter names that stand twice in a declaration, which compilers of 2003 let pass:
/// those that lines "FILE:LINE:COLUMN: error: redefinition of 'TYPE NAME'" of `errors` name.
std::string withoutRepeatedNames(const std::string& preprocessed, const std::string& errors);

/// Preprocessed source in which what those compilers let pass and this one refuses, after lines of `errors` about this
/// very source with columns in bytes, is written as this one wants it:
/// - a parameter's name that stands twice, as above;
/// - a type of a template's argument without `typename`;
/// - a member of a base that depends on a template's argument without `this->`;
/// - a variable of a `for` that is used behind it: its declaration stands before it then;
/// - a member of a class template of its own without `template<>`;
/// - a class that is known only as another one's friend;
/// - what that compiler had beyond the language, see old_extensions.h.
/// The same text if there is nothing of that kind.
std::string curedSource(const std::string& preprocessed, const std::string& errors);

/// Headers that declare what was not declared according to `errors`, each once: the compiler names them, or they are
/// the system's. Compilers of 2003 brought them with others.
std::vector<std::string> missingHeaders(const std::string& errors);

}  // namespace btr::openr
