#pragma once
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/live/act.h"

namespace btr {

/// Writes what reached into a session, one JSON object a line ("format": "uchilsim-log-1"), each line in the file when
/// the call returns: a session that is killed keeps its log up to its last act. The game that it began with is in its
/// first line, so that the log alone plays it again where the robots' files are.
class SessionLogWriter {
 public:
  /// Throws InputError if the file cannot be written.
  SessionLogWriter(const std::string& path, const Game& game);
  ~SessionLogWriter();
  SessionLogWriter(const SessionLogWriter&) = delete;
  SessionLogWriter& operator=(const SessionLogWriter&) = delete;

  void act(long period, const Act& act);
  /// Session::mark() before this period; none a second time for the same one.
  void mark(long period, const std::string& mark);
  /// Where the file ends now [bytes], and that end again: what was written since is taken back.
  long place() const;
  void returnTo(long place);
  /// The session ended before this period.
  void end(long period, const std::string& traceSha256);

 private:
  void write(const std::string& line);

  std::string path_;
  std::FILE* file_;
};

struct SessionLog {
  /// Every so many control periods a session that is logged is marked, see Session::mark().
  static constexpr long markEvery = 50;

  std::string gameSha256;
  std::optional<Game> game{};  ///< it began with it; none in logs of earlier versions
  struct Entry {
    long period;  ///< before which it took effect
    Act act;
  };
  struct Mark {
    long period;  ///< before which it was made
    std::string mark;
    std::size_t acts;  ///< so many were done before it
  };
  std::vector<Entry> acts;    ///< in their order
  std::vector<Mark> marks{};  ///< in their order
  long periods = 0;           ///< how long it went on; of a session that was killed, up to its last line
  std::string traceSha256;    ///< "" of a session that was killed
};

/// Throws InputError with file and line. A last line that was cut off in the middle is left out.
SessionLog loadSessionLog(const std::string& path);

/// Whether a file says of itself that it is one.
bool isSessionLog(const std::string& path);

/// The hash that a log is bound to, and whether the game itself is in it. Reads the first line only; throws as above.
struct LogHead {
  std::string gameSha256;
  bool hasGame = false;
};
LogHead headOfSessionLog(const std::string& path);

/// What a log is bound to: the hash of the game that it began with.
std::string gameSha256(const Game& game);

}  // namespace btr
