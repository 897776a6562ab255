#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr::openr {

/// What may be set on a stick's program: `parameters.json` at the top of the stick ("format":
/// "uchilsim-openr-parameters-1"). Throws InputError with file, place, value and what is allowed.
std::vector<Parameter> stickParameters(const std::string& stick);

/// The text of /MS/PARAMS.TXT: a line NAME VALUE for each.
std::string parametersText(std::span<const Parameter> declared, std::span<const double> values);

/// Where the trials of one experiment have their copies of a stick: a folder of the system's for temporary files. It
/// belongs to the process that made it, above the workers whose trials use it, which may be killed at any moment: it
/// goes with that process's object, or, if that process was killed too, when the next one is made on this machine.
class StickShelf {
 public:
  /// Removes those whose owners are gone. Never throws.
  StickShelf();
  ~StickShelf();
  StickShelf(const StickShelf&) = delete;
  StickShelf& operator=(const StickShelf&) = delete;

  /// An empty folder for this process, in the owner or in one that it has forked; those of ended processes go. Throws
  /// InputError if there can be none.
  std::string newFolder() const;
  const std::string& folder() const { return folder_; }  ///< "" if none could be made

 private:
  std::string folder_, problem_;
  int lock_ = -1;  ///< held as long as the owner, or one of those that it has forked, lives
  int owner_;      ///< its process
};

/// A copy of a stick that is there as long as this lives, with such a PARAMS.TXT: what a program writes hurts nobody
/// else.
class PrivateStick {
 public:
  /// Throws InputError if it cannot be copied.
  PrivateStick(const StickShelf& shelf, const std::string& stick, const std::string& parametersText);
  ~PrivateStick();
  PrivateStick(const PrivateStick&) = delete;
  PrivateStick& operator=(const PrivateStick&) = delete;

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

}  // namespace btr::openr
