#pragma once
#include <map>
#include <string>
#include <vector>

namespace btr::openr {

/// A line `Service : "Object.Sub.Type.S", First(), Second()` of a stub.cfg.
struct StubService {
  std::string name;           ///< with all four parts
  std::string first, second;  ///< methods (Control and Ready, or Connect and Notify); empty: the handler alone
  std::string sub() const;
};

/// What a stub.cfg says of an object.
struct StubConfig {
  std::string object;  ///< name of its class, and of the header that declares it
  std::vector<StubService> subjects, observers;
  std::vector<std::string> extras;
};

/// Reads a stub.cfg. Throws InputError with file, line, value and what is allowed.
StubConfig stubConfigFrom(const std::string& text, const std::string& file);

/// The files of the stub by name: def.h, entry.h, XStub.h and XStub.cc.
std::map<std::string, std::string> stubFiles(const StubConfig& config);

}  // namespace btr::openr
