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

/// A copy of a stick that is there as long as this lives, with such a PARAMS.TXT: what a program writes hurts nobody
/// else.
class PrivateStick {
 public:
  /// In the system's folder for temporary files. Throws InputError if it cannot be copied.
  PrivateStick(const std::string& stick, const std::string& parametersText);
  ~PrivateStick();
  PrivateStick(const PrivateStick&) = delete;
  PrivateStick& operator=(const PrivateStick&) = delete;

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

}  // namespace btr::openr
