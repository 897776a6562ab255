#pragma once
#include <initializer_list>
#include <string>

namespace btr::openr {

/// With capital letters, as the robot's file system has names.
std::string upper(std::string text);
/// The bytes of a file; none where it cannot be read.
std::string content(const std::string& path);
/// Whether one of the parts stands in the text.
bool hasAny(const std::string& text, std::initializer_list<const char*> parts);

}  // namespace btr::openr
