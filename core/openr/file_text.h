#pragma once
#include <initializer_list>
#include <string>

namespace btr::openr {

/// With capital letters, as the robot's file system has names.
std::string upper(std::string text);
/// The bytes of a file; none where it cannot be read.
std::string content(const std::string& path);
/// Throws InputError if the file cannot be written.
void writeContent(const std::string& path, const std::string& text);
/// Whether one of the parts stands in the text.
bool hasAny(const std::string& text, std::initializer_list<const char*> parts);

}  // namespace btr::openr
