#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace btr::openr {

using Place = std::pair<std::string, int>;  ///< file and line

/// What the compiler said about a place.
struct Complaint {
  std::string file, function, text;  ///< "In member function '…'" before it
  int line, column;                  ///< both from 1; the column in bytes
};

/// The lines "FILE:LINE:COLUMN: error: TEXT" of `errors`, in their order.
std::vector<Complaint> complaintsOf(const std::string& errors);

/// Where each line of each file begins in a preprocessed text. A line that stands there several times (a header without
/// a guard) is its last one.
std::map<Place, std::size_t> lineBegins(const std::string& preprocessed);

/// The text with blanks for what stands in quotes and in lines that begin with #, as long as it was.
std::string withoutLiterals(std::string text);

bool isNameCharacter(char c);

struct Change {
  std::size_t length;  ///< of what it replaces
  std::string text;
};

/// By place, so that two complaints about one place change it once.
using Changes = std::map<std::size_t, Change>;

std::string changed(std::string text, const Changes& changes);

}  // namespace btr::openr
