#pragma once
#include <atomic>
#include <string>
#include <vector>

namespace btr {

/// The machines of a file, one a line as GNU parallel reads them ("2/lab7", "ada@lab8"); empty lines and what follows a
/// "#" play no part. Throws InputError for a file that cannot be read or names none.
std::vector<std::string> requireHosts(const std::string& file);

/// Works on elements of the job in `folder` on these machines, one at a time on each unless the file says more, by GNU
/// parallel over ssh: each element's database, or its cases, goes there and comes back, nothing else is shared.
/// Machines must have btr where this one has it. A machine that does not answer is named on stderr and left out. While
/// they work their states are written into the folder. Returns when all are done, or after `stop`: then nothing new
/// begins, and what is being worked on stops cleanly and comes back. Throws InputError if GNU parallel is not there, no
/// machine answers, or another process works on this job.
void runOverSsh(const std::string& folder, const std::string& hostsFile, const std::vector<std::size_t>& numbers,
                const std::atomic<bool>& stop);

/// True while some process of this machine works on the job over ssh.
bool isWorkedOnOverSsh(const std::string& folder);

/// Asks that process to stop. Throws InputError if there is none.
void stopOverSsh(const std::string& folder);

}  // namespace btr
