#include "core/spec/error.h"
#include "core/spec/utf8.h"
#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"
#include "core/store/packing.h"

namespace btr {
namespace {

constexpr const char* recordingColumns =
    "SELECT id, experiment_id, individual_id, name, sha256, mapping_json, source, added_at FROM recording ";

RecordingRecord recordingOf(const Query& row) {
  RecordingRecord r;
  row.get(r.id, r.experiment, r.individual, r.name, r.sha256, r.mappingJson, r.source, r.addedAt);
  return r;
}

}  // namespace

Id Database::addRecording(const RecordingRecord& r) {
  requireUtf8(r.name, path() + " recording, name");
  requireUtf8(r.source, path() + " recording, source");
  return connection_->write([&] {
    requireRow(*connection_, "experiment", r.experiment);
    if (r.individual != 0) requireRow(*connection_, "individual", r.individual);
    const std::string hash = sha256(r.csv);
    if (!r.sha256.empty() && r.sha256 != hash)
      throw InputError(path() + " recording " + r.name, "the hash " + r.sha256, "that of its content, " + hash);
    const Id id =
        insert(*connection_,
               "INSERT INTO recording (experiment_id, individual_id, name, sha256, mapping_json, source, added_at) "
               "VALUES (?, ?, ?, ?, ?, ?, ?)",
               r.experiment, Reference{r.individual}, r.name, hash, r.mappingJson, r.source, orNow(r.addedAt));
    insert(*connection_, "INSERT INTO recording_data (recording_id, size_bytes, csv) VALUES (?, ?, ?)", id,
           static_cast<std::int64_t>(r.csv.size()), Blob{deflated(r.csv)});
    return id;
  });
}

std::vector<RecordingRecord> Database::recordings(Id experiment) const {
  return connection_->read([&] {
    std::vector<RecordingRecord> all;
    for (Query row(*connection_, (std::string(recordingColumns) + "WHERE experiment_id = ? ORDER BY id").c_str(),
                   experiment);
         row.next();)
      all.push_back(recordingOf(row));
    return all;
  });
}

RecordingRecord Database::recording(Id id) const {
  return connection_->read([&] {
    Query row(*connection_, (std::string(recordingColumns) + "WHERE id = ?").c_str(), id);
    if (!row.next()) refuseUnknown(*connection_, "recording", id);
    RecordingRecord r = recordingOf(row);
    Query data(*connection_, "SELECT size_bytes, csv FROM recording_data WHERE recording_id = ?", id);
    if (data.next()) {
      std::int64_t size = 0;
      std::string packed;
      data.get(size, packed);
      r.csv = connection_->unpacked([&] { return inflated(packed, size); });
    }
    if (sha256(r.csv) != r.sha256) connection_->refuse("is damaged: the recording " + r.name + " has changed");
    return r;
  });
}

}  // namespace btr
