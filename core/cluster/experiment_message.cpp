#include "core/cluster/experiment_message.h"

#include "core/spec/error.h"

namespace btr {

Parts experimentParts(const RunRecord& record) {
  Parts parts{record.specJson, record.sceneJson};
  for (const StoredFile& file : record.files) parts.insert(parts.end(), {file.name, file.sha256, file.content});
  return parts;
}

RunRecord experimentFrom(Parts::const_iterator begin, Parts::const_iterator end) {
  constexpr std::ptrdiff_t head = 2, perFile = 3;
  if (end - begin < head || (end - begin - head) % perFile != 0) throw InputError("an experiment that is cut short");
  RunRecord record;
  record.specJson = begin[0];
  record.sceneJson = begin[1];
  for (Parts::const_iterator at = begin + head; at != end; at += perFile) {
    StoredFile file;
    file.name = at[0];
    file.sha256 = at[1];
    file.content = at[2];
    record.files.push_back(std::move(file));
  }
  return record;
}

}  // namespace btr
