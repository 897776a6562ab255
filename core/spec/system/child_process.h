#pragma once

#include <sys/types.h>

#include <cstddef>

namespace btr {

/// Whether a child process ends by itself within so many milliseconds; it is still to be waited for.
bool endsWithin(pid_t process, int patience_ms);

/// Reads exactly `size` bytes of a pipe or a socket; false where it ends or fails before.
bool readAll(int file, char* data, std::size_t size);

}  // namespace btr
