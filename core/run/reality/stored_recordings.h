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

/// A recording that was read to its end: fit to be kept.
struct CheckedRecording {
  RecordingRecord record;  ///< without experiment and individual
  StoredRecording stored;  ///< but for what the database says of it
};

/// Reads a recording with its mapping (`mapping`, else the one beside it or beside `scene`, else none), so that nothing
/// damaged gets in. Throws InputError with line and column.
CheckedRecording checkRecording(const std::string& path, const std::string& mapping = "",
                                const std::string& scene = "");

/// Keeps the bytes of both with their SHA-256. `individual` is the one that was recorded, 0 for none.
StoredRecording keepRecording(Database& database, Id experiment, CheckedRecording checked, Id individual = 0);

/// Both.
StoredRecording importRecording(Database& database, Id experiment, const std::string& path,
                                const std::string& mapping = "", Id individual = 0, const std::string& scene = "");

/// Writes a stored recording and its mapping into a folder as NAME.csv and NAME.mapping.json, as an analysis reads
/// them. Returns the path of the CSV. Throws InputError; an existing file of other content is not replaced.
std::string exportRecording(const Database& database, Id recording, const std::string& folder);
/// The same of one that was read before.
std::string writeRecordingFiles(const RecordingRecord& record, const std::string& folder);

}  // namespace btr
