#pragma once
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/live/act.h"

namespace btr {

/// Writes what reached into a session, one JSON object a line ("format": "uchilsim-log-1"), each line in the file when
/// the call returns: a session that is killed keeps its log up to its last act.
class SessionLogWriter {
 public:
  /// Throws InputError if the file cannot be written.
  SessionLogWriter(const std::string& path, const Game& game);
  ~SessionLogWriter();
  SessionLogWriter(const SessionLogWriter&) = delete;
  SessionLogWriter& operator=(const SessionLogWriter&) = delete;

  void act(long period, const Act& act);
  /// The session ended before this period.
  void end(long period, const std::string& traceSha256);

 private:
  void write(const std::string& line);

  std::string path_;
  std::FILE* file_;
};

struct SessionLog {
  std::string gameSha256;
  struct Entry {
    long period;  ///< before which it took effect
    Act act;
  };
  std::vector<Entry> acts;  ///< in their order
  long periods = 0;         ///< how long it went on; of a session that was killed, up to its last act
  std::string traceSha256;  ///< "" of a session that was killed
};

/// Throws InputError with file and line. A last line that was cut off in the middle is left out.
SessionLog loadSessionLog(const std::string& path);

/// What a log is bound to: the hash of the game that it began with.
std::string gameSha256(const Game& game);

}  // namespace btr
