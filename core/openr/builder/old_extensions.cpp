#include "core/openr/builder/old_extensions.h"

#include <algorithm>
#include <cctype>

namespace btr::openr {
namespace {

bool isBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Where the parenthesis at `open` is closed; npos if it is not.
std::size_t closed(const std::string& text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size() && text[i] != ';'; ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return i;
  }
  return std::string::npos;
}

/// A cast's variable is told to be of that type: "(T)x" becomes "*(T*)&x".
void castOfVariable(const std::string& bare, std::size_t at, Changes& changes) {
  while (at < bare.size() && (isBlank(bare[at]) || bare[at] == '+' || bare[at] == '-')) ++at;
  for (; at < bare.size() && bare[at] == '('; ++at) {
    const auto end = closed(bare, at);
    if (end == std::string::npos || (at > 0 && isNameCharacter(bare[at - 1]))) return;  // a call's arguments
    const std::string type = bare.substr(at + 1, end - at - 1);
    if (type.find('(') != std::string::npos) continue;
    const bool isType = std::all_of(type.begin(), type.end(),
                                    [](char c) { return isNameCharacter(c) || isBlank(c) || c == '*' || c == ':'; });
    if (!isType) return;
    changes[at] = {1, "*("};
    changes[end] = {1, "*)&"};
    return;
  }
}

/// "In member function 'void A::b(int)':" is about b.
std::string functionName(const std::string& within) {
  const auto open = within.find('\'');
  const auto arguments = within.find('(', open == std::string::npos ? 0 : open);
  if (open == std::string::npos || arguments == std::string::npos) return "";
  auto begin = arguments;
  while (begin > open + 1 && (isNameCharacter(within[begin - 1]) || within[begin - 1] == '~')) --begin;
  return within.substr(begin, arguments - begin);
}

/// Names of the function between literals on the line at `begin` become literals.
void functionNames(const std::string& text, std::size_t begin, const std::string& name, Changes& changes) {
  const auto end = std::min(text.find('\n', begin), text.size());
  for (const std::string word : {"__FUNCTION__", "__PRETTY_FUNCTION__"}) {
    for (auto at = text.find(word, begin); at < end; at = text.find(word, at + 1)) {
      const auto before = text.find_last_not_of(" \t", at == 0 ? 0 : at - 1);
      const auto after = text.find_first_not_of(" \t", at + word.size());
      const auto isQuote = [&](std::size_t i) { return i < text.size() && text[i] == '"'; };
      if (isQuote(before) || isQuote(after)) changes[at] = {word.size(), '"' + name + '"'};
    }
  }
}

/// "a <? b" becomes "a <btr_least> b", "a >?= b;" "a <btr_most>= (b);".
void lesserOrGreater(const std::string& bare, std::size_t question, Changes& changes) {
  if (question == 0 || bare[question] != '?' || (bare[question - 1] != '<' && bare[question - 1] != '>')) return;
  const std::string name = bare[question - 1] == '<' ? "btr_least" : "btr_most";
  const bool assigns = question + 1 < bare.size() && bare[question + 1] == '=';
  changes[question - 1] = {assigns ? 3u : 2u, "<" + name + (assigns ? ">= (" : ">")};
  if (!assigns) return;
  int depth = 0;
  for (std::size_t i = question + 2; i < bare.size(); ++i) {
    const char c = bare[i];
    if (depth == 0 && (c == ';' || c == ',' || c == ')' || c == ']' || c == '}')) {
      changes[i] = {0, ")"};
      return;
    }
    depth += c == '(' || c == '[' || c == '{' ? 1 : c == ')' || c == ']' || c == '}' ? -1 : 0;
  }
}

}  // namespace

void addOldExtensions(const std::string& preprocessed, const std::string& bare,
                      const std::map<Place, std::size_t>& begins, const std::vector<Complaint>& complaints,
                      Changes& changes) {
  for (const Complaint& complaint : complaints) {
    const auto line = begins.find({complaint.file, complaint.line});
    if (line == begins.end()) continue;
    const std::size_t at = line->second + static_cast<std::size_t>(complaint.column - 1);
    if (at >= bare.size()) continue;
    const std::string& text = complaint.text;
    if (text.rfind("lvalue required as ", 0) == 0)
      castOfVariable(bare, at, changes);
    else if (text == "expected primary-expression before '?' token")
      lesserOrGreater(bare, at, changes);
    else if (text.rfind("expected ", 0) == 0)
      functionNames(preprocessed, line->second, functionName(complaint.function), changes);
  }
}

}  // namespace btr::openr
