#pragma once
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace btr::cli {

/// btr-camera in a process of its own, told by lines on its standard input.
class CameraProcess {
 public:
  /// `words`: its command and options. With `answers` what it writes can be read, else it goes to standard error.
  /// Throws InputError if it cannot be started.
  CameraProcess(std::vector<std::string> words, bool answers);
  /// Ends its input and waits for its end; one that answers and hangs is ended.
  ~CameraProcess();
  CameraProcess(const CameraProcess&) = delete;
  CameraProcess& operator=(const CameraProcess&) = delete;

  /// False if it has ended.
  bool send(const std::string& line);
  /// So many bytes of its answers; false if it ended before, or hangs.
  bool read(std::uint8_t* bytes, std::size_t count);
  /// Ends its input and waits. Throws InputError if it crashed, AlreadySaid if it ended with an error.
  void finish();

 private:
  const bool answers_;
  pid_t process_ = -1;
  int in_ = -1, out_ = -1;  ///< our ends
};

}  // namespace btr::cli
