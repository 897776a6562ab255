#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace btr {

/// How a program ended.
struct ChildEnd {
  int exitCode = 0;  ///< 128 + the signal's number where it was killed
  std::string out, err;
};

/// Runs a program, looked for on the path, to its end. Throws InputError if it cannot be started.
ChildEnd runChild(const std::vector<std::string>& words);
/// Its standard output. Throws InputError with the last line of its errors if it did not end well.
std::string outputOfChild(const std::vector<std::string>& words);

/// Starts a program; standard output and error go to the end of a file. Throws InputError if it cannot be started.
pid_t startChild(const std::vector<std::string>& words, const std::string& log);

/// Starts a program in a process group of its own, so that Ctrl-C is not told to it: standard output goes to `out`
/// (from which its reader reads, and which its caller closes), its errors to the end of a file; it inherits `kept`,
/// too. Throws InputError if it cannot be started.
pid_t startApart(const std::vector<std::string>& words, const std::string& log, int& out, int kept);

/// Waits for it; 128 + the signal's number where it was killed.
int exitCodeOf(pid_t child);

/// The last line that is not empty.
std::string lastLine(const std::string& text);

}  // namespace btr
