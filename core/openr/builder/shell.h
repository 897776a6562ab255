#pragma once
#include <filesystem>
#include <string>

namespace btr::openr {

/// The text as one word of a shell's command.
std::string shellWord(const std::string& text);
/// Runs a shell command in `folder`; `said` gets its errors behind what it has. The exit status. Throws InputError
/// where no shell can be started.
int runInShell(const std::filesystem::path& folder, const std::string& command, std::string& said);

}  // namespace btr::openr
