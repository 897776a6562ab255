#include "core/openr/runtime/robot/gunzip.h"

#include <sys/stat.h>
#include <zlib.h>

namespace btr::openr {

bool unpackedFile(const std::string& path, std::vector<char>& content) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return false;
  gzFile in = gzopen(path.c_str(), "rb");  // reads what is not packed as it is
  if (in == nullptr) return false;
  constexpr std::size_t most = 64u << 20, piece = 1u << 16;
  int count = 0;
  content.clear();
  do {
    const std::size_t had = content.size();
    content.resize(had + piece);
    count = gzread(in, content.data() + had, piece);
    content.resize(had + (count > 0 ? static_cast<std::size_t>(count) : 0));
  } while (count > 0 && content.size() < most);
  gzclose(in);
  return count == 0;
}

}  // namespace btr::openr
