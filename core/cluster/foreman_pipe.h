#pragma once
#include <optional>

#include "core/cluster/parts.h"

namespace btr {

/// Where a foreman's messages come from and go to (foreman.h).
struct ForemanPipe {
  int in = -1, out = -1;

  /// Waits for a message; none when nobody is there any more.
  std::optional<Parts> read() const;
  /// Ends the process when nobody is there any more.
  void write(const Parts& parts) const;
};

/// This process's standard streams as they were. From now on nothing comes from standard input, and what is written to
/// standard output goes to standard error.
ForemanPipe takeStandardStreams();

/// HEAD and what follows it, as a message.
Parts joined(Parts head, const Parts& rest);

}  // namespace btr
