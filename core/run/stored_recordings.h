#pragma once
#include <string>
#include <vector>

#include "core/store/database.h"

namespace btr {

struct StoredRecording {
  Id id = 0;
  bool isNew = false;  ///< false: the experiment has this file with this mapping already
  std::size_t trials = 0, rows = 0;
  std::vector<std::string> notes;
};

/// Reads a recording with its mapping (`mapping`, else the one beside it or beside `scene`, else none), so that nothing
/// damaged gets in, and keeps the bytes of both with their SHA-256. `individual` is the one that was recorded, 0 for
/// none. Throws InputError with line and column.
StoredRecording importRecording(Database& database, Id experiment, const std::string& path,
                                const std::string& mapping = "", Id individual = 0, const std::string& scene = "");

/// Writes a stored recording and its mapping into a folder as NAME.csv and NAME.mapping.json, as an analysis reads
/// them. Returns the path of the CSV. Throws InputError; an existing file of other content is not replaced.
std::string exportRecording(const Database& database, Id recording, const std::string& folder);

}  // namespace btr
