#pragma once
#include <string>

namespace btr {

/// A line of an equation (EffectLaw::equation) as HTML: single letters in italics, words upright, the letters behind _
/// below the line and those behind ^ above it. For pages and for Qt's rich text.
std::string equationHtml(const std::string& equation);

}  // namespace btr
