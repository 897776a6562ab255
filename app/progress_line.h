#pragma once
#include <unistd.h>

#include <cstdio>
#include <string>

#include "app/btr_commands.h"

namespace btr::cli {

/// What the terminal sees; with --progress one line "STAGE SHARE" for the window.
class ProgressLine {
 public:
  ProgressLine(Shell& shell, bool lines) : shell_(shell), lines_(lines), show_(isatty(STDERR_FILENO)) {}
  bool operator()(const std::string& stage, double share) {
    if (lines_ && (stage != stage_ || share != share_)) {
      std::fprintf(stderr, "%s %.3f\n", stage.c_str(), share);
      stage_ = stage;
      share_ = share;
    } else if (show_ && !lines_) {
      std::fprintf(stderr, "\r%3.0f %% %s \x1b[K", 100 * share, stage.c_str());
    }
    return !*shell_.stop;
  }
  void end() const {
    if (show_ && !lines_) std::fprintf(stderr, "\n");
  }

 private:
  Shell& shell_;
  bool lines_, show_;
  std::string stage_;  ///< what a line was last written of
  double share_ = -1;
};

}  // namespace btr::cli
