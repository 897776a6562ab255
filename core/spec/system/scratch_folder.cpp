#include "core/spec/system/scratch_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/spec/error.h"

namespace btr {

ScratchFolder::ScratchFolder(const std::string& name) {
  std::string pattern = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
  if (!mkdtemp(pattern.data())) throw InputError(pattern + ": the folder cannot be made: " + std::strerror(errno));
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;  // a temporary folder: nobody can do more about it
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace btr
