#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw InputError(path + ": " + what); }
std::string reason() { return std::strerror(errno); }

/// Closes a file descriptor at the end of a block.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

void writeAll(int file, const std::string& content, const std::string& path) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t count = ::write(file, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot be written: " + reason());
    done += static_cast<std::size_t>(count);
  }
}

// What a link points to, also if nothing is there yet: the link stays.
fs::path targetOf(fs::path path) {
  std::error_code ignored;
  constexpr int mostLinks = 40;  // as the system allows
  for (int links = 0; links < mostLinks && fs::is_symlink(path, ignored); ++links)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  return path;
}

}  // namespace

std::string readFile(const std::string& path, std::size_t limit) {
  // O_NONBLOCK: opening a pipe that nobody writes to must not wait for ever.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0) fail(path, "cannot be read: " + reason());
  if (!S_ISREG(status.st_mode)) fail(path, "is not a regular file");
  const auto tooLarge = [&] { fail(path, "is larger than the allowed " + std::to_string(limit) + " bytes"); };
  if (static_cast<std::uintmax_t>(status.st_size) > limit) tooLarge();

  // The file may grow or shrink while it is read: its size is only a hint.
  std::string content(static_cast<std::size_t>(status.st_size) + 1, '\0');
  std::size_t done = 0;
  for (;;) {
    const ssize_t count = ::read(file.number, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot be read: " + reason());
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
    if (done > limit) tooLarge();
    if (done == content.size()) content.resize(content.size() * 2);
  }
  content.resize(done);
  return content;
}

namespace {

/// Whether this process has the file open, but for what its standard streams are joined to.
bool isOpenHere(const std::string& path) {
  struct stat wanted {};
  if (::stat(path.c_str(), &wanted) != 0) return false;
  std::error_code ignored;
  for (const fs::directory_entry& descriptor : fs::directory_iterator("/proc/self/fd", ignored)) {
    struct stat open {};
    if (std::stoi(descriptor.path().filename()) <= STDERR_FILENO) continue;
    if (::stat(descriptor.path().c_str(), &open) == 0 && open.st_dev == wanted.st_dev && open.st_ino == wanted.st_ino)
      return true;
  }
  return false;
}

}  // namespace

void refuseDatabase(const std::string& path) {
  static constexpr std::string_view begin = "SQLite format 3";
  // Looking into a database of our own would drop this process's locks on it as the look ends.
  if (isOpenHere(path)) fail(path, "is in use by this program; choose another name for what is written");
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  char bytes[begin.size()] = {};
  if (file.number < 0 || ::read(file.number, bytes, sizeof bytes) != static_cast<ssize_t>(sizeof bytes)) return;
  if (std::string_view(bytes, sizeof bytes) == begin)
    fail(path, "is a database and would be replaced; choose another name for what is written");
}

void writeFile(const std::string& path, const std::string& content) {
  std::error_code ignored;
  // A device or pipe is written as it is; a link keeps pointing to its target.
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail(path, "is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const Descriptor device{::open(path.c_str(), O_WRONLY | O_CLOEXEC)};
    if (device.number < 0) fail(path, "cannot be written: " + reason());
    writeAll(device.number, content, path);
    return;
  }
  refuseDatabase(path);
  const fs::path target = targetOf(path);
  const std::string temporary = target.string() + ".new-" + std::to_string(::getpid());
  try {
    const Descriptor file{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (file.number < 0) fail(path, "cannot be written: " + reason());
    if (fs::exists(status)) ::fchmod(file.number, static_cast<mode_t>(status.permissions()));
    writeAll(file.number, content, path);
    if (::fsync(file.number) != 0) fail(path, "cannot be written: " + reason());
    if (::rename(temporary.c_str(), target.c_str()) != 0) fail(path, "cannot be replaced: " + reason());
  } catch (const InputError&) {
    ::unlink(temporary.c_str());
    throw;
  }
  // The new name itself must reach the disk too.
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const Descriptor directory{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (directory.number >= 0) ::fsync(directory.number);
}

}  // namespace btr
