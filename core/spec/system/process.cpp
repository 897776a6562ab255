#include "core/spec/system/process.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <initializer_list>

#include "core/spec/system/crash_report.h"

namespace btr {
namespace {

void tellPerson(const char* text, std::size_t size) {
  // Nothing more can be done where standard error is gone.
  [[maybe_unused]] ssize_t written = write(STDERR_FILENO, text, size);
  written = write(STDERR_FILENO, "\n", 1);
}

}  // namespace

void beginProgram() {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  // The lowest free number is taken: going upwards fills exactly the gaps. The wrong direction makes a write fail, as
  // it did when the file was closed.
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(file, F_GETFD) < 0) open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  tellCrashes(tellPerson, true);
}

}  // namespace btr
