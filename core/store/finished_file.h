#pragma once
#include <string>

namespace btr {

/// Removes a draft with what SQLite keeps beside it.
void removeDraft(const std::string& draft);

enum class IfThere { keep, replace };
/// Gives a complete draft its name, so that a process that dies meanwhile leaves no half-made file. False, and nothing
/// changes, if a file of that name is there and is to be kept. Throws InputError if it cannot be named. The draft is
/// gone afterwards; the name has reached the disk.
bool nameFinishedFile(const std::string& draft, const std::string& path, IfThere ifThere);

}  // namespace btr
