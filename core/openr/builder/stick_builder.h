#pragma once
#include <functional>
#include <string>
#include <vector>

namespace btr::openr {

/// From folders with sources of OPEN-R programs to the stick on which they run.
struct StickBuild {
  struct Object {
    std::string folder;                ///< of its sources
    std::vector<std::string> modules;  ///< "MVHEAD7.BIN"; empty: it could not be built
    std::string said;                  ///< by the compiler, as it says it
  };
  std::vector<Object> objects;
  std::vector<std::string> absent;  ///< modules that OBJECT.CFG names and the stick does not have
  bool complete() const;
};

struct StickBuildOptions {
  std::vector<std::string> folders;  ///< a sample with its objects' folders and MS, or one object's folder
  std::string out;                   ///< the stick: made if it is not there, added to if it is
  std::string sdk;                   ///< empty: share/uchilsim/openr-sdk beside this program
  std::function<void(const std::string&)> progress;  ///< what is done now, in a line
};

/// Builds every object below the folders, in copies: those with a Makefile by it, others from all sources in their
/// folder. Modules, configuration and data of the samples' MS folders are put on the stick; lists that are there
/// already are added to, each line once. Throws InputError if there is nothing to build or the stick cannot be written;
/// what the compiler refuses is in the result.
StickBuild buildStick(const StickBuildOptions& options);

}  // namespace btr::openr
