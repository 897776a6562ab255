// Runs of another database: its rows with their numbers moved behind ours. What refers to what is read from the schema,
// so a table that a later migration adds comes along by itself.
#include <SQLiteCpp/Database.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/spec/error.h"
#include "core/store/connection.h"
#include "core/store/database.h"

namespace btr {
namespace {

/// The other file under the name "other", as long as this lives.
class Attached {
 public:
  Attached(const Connection& connection, const std::string& path) : connection_(connection) {
    Query(connection, "ATTACH ? AS other", path).next();
  }
  ~Attached() { connection_.database().tryExec("DETACH other"); }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  const Connection& connection_;
};

struct Column {
  std::string name, table;  ///< table: whose id it holds; empty: none's
};

class Schema {
 public:
  explicit Schema(const Connection& connection) : connection_(connection) {
    Query names(connection, "SELECT name FROM main.sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'");
    std::string name;
    while (names.next()) {
      names.get(name);
      tables_.push_back(name);
    }
    for (const std::string& table : tables_) read(table);
  }
  const std::vector<std::string>& tables() const { return tables_; }
  bool hasId(const std::string& table) const { return std::ranges::count(columns_.at(table), std::string("id")) > 0; }
  /// With the table whose id each holds, also through keys of several columns.
  std::vector<Column> columns(const std::string& table) const {
    std::vector<Column> list;
    for (const std::string& name : columns_.at(table)) list.push_back({name, owner(table, name)});
    return list;
  }

 private:
  struct Key {
    std::string table, to;
  };
  void read(const std::string& table) {
    Query columns(connection_, "SELECT name FROM pragma_table_info(?)", table);
    std::string name;
    while (columns.next()) {
      columns.get(name);
      columns_[table].push_back(name);
    }
    Query keys(connection_, "SELECT \"from\", \"table\", \"to\" FROM pragma_foreign_key_list(?)", table);
    Key key;
    while (keys.next()) {
      keys.get(name, key.table, key.to);
      keys_[{table, name}].push_back(key);
    }
  }
  std::string owner(const std::string& table, const std::string& column) const {
    if (column == "id") return table;
    const auto found = keys_.find({table, column});
    if (found == keys_.end()) return "";
    for (const Key& key : found->second) {
      if (key.table == table && key.to == column) continue;
      if (const std::string of = owner(key.table, key.to); !of.empty()) return of;
    }
    return "";
  }

  const Connection& connection_;
  std::vector<std::string> tables_;
  std::map<std::string, std::vector<std::string>> columns_;
  std::map<std::pair<std::string, std::string>, std::vector<Key>> keys_;
};

/// Which rows of the other database are copied: all, or those of some runs.
class Choice {
 public:
  Choice(const Schema& schema, const std::vector<Id>& runs) : schema_(schema) {
    for (const Id run : runs) list_ += (list_.empty() ? "(" : ", ") + std::to_string(run);
    if (!list_.empty()) list_ += ")";
  }
  bool isAll() const { return list_.empty(); }
  /// A condition on a row of the table; empty where there is none.
  std::string of(const std::string& table) const {
    // Files are shared by content.
    if (isAll() || table == "stored_file") return "";
    if (table == "run") return "id IN " + list_;
    if (table == "experiment") return "id IN (SELECT experiment_id FROM other.run WHERE id IN " + list_ + ")";
    // Grids and rigs are no runs.
    if (table.starts_with("grid") || table == "rig_simulator") return "0";
    std::string all;
    for (const Column& column : schema_.columns(table)) {
      if (column.table == "run") return column.name + " IN " + list_;
      if (column.table.empty() || column.table == table) continue;
      all += (all.empty() ? "(" : " AND (") + column.name + " IS NULL OR " + column.name +
             " IN (SELECT id FROM other." + column.table + " WHERE " + of(column.table) + "))";
    }
    return all;
  }
  /// Of the runs that are chosen.
  std::string ofRuns(const std::string& id) const { return isAll() ? "" : " AND " + id + " IN " + list_; }

 private:
  const Schema& schema_;
  std::string list_;
};

void refuseWhatIsMissing(const Connection& connection, const std::vector<Id>& runs, const std::string& path) {
  for (const Id run : runs)
    if (!Query(connection, "SELECT id FROM other.run WHERE id = ?", run).next())
      connection.refuse("there is no run " + std::to_string(run) + " in " + path + "; nothing was copied");
}

/// Numbers inside an evidence text: ["individuals", …] and ["recordings", …] of JSON objects.
std::string movedEvidence(const std::map<std::string, std::int64_t>& offsets) {
  std::string text = "evidence";
  for (const auto& [key, table] : {std::pair{"individuals", "individual"}, {"recordings", "recording"}}) {
    const std::string path = std::string("'$.") + key + "'";
    text = "CASE WHEN json_valid(evidence) AND json_type(evidence, " + path + ") = 'array' THEN json_set(" + text +
           ", " + path + ", (SELECT json_group_array(value + " + std::to_string(offsets.at(table)) +
           ") FROM json_each(evidence, " + path + "))) ELSE " + text + " END";
  }
  return text;
}

void refuseWhatIsThere(const Connection& connection, const Choice& choice, const std::string& path) {
  // `same`: the first pair of ids, ours and theirs, of rows that are the same.
  const auto refuse = [&](const std::string& kind, const std::string& is, const std::string& why,
                          const std::string& same) {
    Query pairs(connection, same.c_str());
    if (!pairs.next()) return;
    Id ours = 0, theirs = 0;
    pairs.get(ours, theirs);
    connection.refuse(kind + " " + std::to_string(ours) + " " + is + " " + kind + " " + std::to_string(theirs) +
                      " of " + path + why + "; nothing was copied");
  };
  refuse("run", "is", " (the same experiment, seed and start)",
         "SELECT a.id, b.id FROM main.run a JOIN other.run b ON a.spec_sha256 = b.spec_sha256 AND a.seed = b.seed "
         "AND a.started_at = b.started_at" +
             choice.ofRuns("b.id") + " ORDER BY b.id LIMIT 1");
  if (!choice.isAll()) return;
  refuse("grid", "learns what", " learns (the same points, method and seed)",
         "SELECT a.id, b.id FROM main.grid a JOIN other.grid b ON a.spec_sha256 = b.spec_sha256 "
         "AND a.method = b.method AND a.seed = b.seed ORDER BY b.id LIMIT 1");
  refuse("rig", "has a version of", " (the same simulator from the same report at the same time)",
         "SELECT a.experiment_id, b.experiment_id FROM main.rig_simulator a JOIN other.rig_simulator b "
         "ON a.number > 0 AND b.number > 0 AND a.created_at = b.created_at AND a.simulator_json = b.simulator_json "
         "AND a.evidence = b.evidence ORDER BY b.id LIMIT 1");
}

}  // namespace

MergedRuns Database::merge(const std::string& path, std::size_t largestTrace, const std::vector<Id>& runs) {
  std::string source;
  {
    // Refuses what is no database of ours, an older or a damaged one, and says why.
    const Database other = open(path, Mode::readOnly);
    source = other.connection_->database().getFilename();
  }
  if (source == connection_->database().getFilename()) connection_->refuse("its own runs are there already");
  const Connection& c = *connection_;
  const Attached attached(c, source);
  const Schema schema(c);
  const Choice choice(schema, runs);
  return c.write([&] {
    refuseWhatIsMissing(c, runs, path);
    refuseWhatIsThere(c, choice, path);
    c.database().exec("PRAGMA defer_foreign_keys = ON");
    std::map<std::string, std::int64_t> offsets;
    for (const std::string& table : schema.tables())
      if (schema.hasId(table))
        offsets[table] = *Query(c, ("SELECT ifnull(max(id), 0) FROM main." + table).c_str()).value<std::int64_t>();

    // Experiments of the same name and specification are one.
    std::map<Id, Id> same;
    Query known(c,
                "SELECT b.id, max(a.id) FROM main.experiment a JOIN other.experiment b ON a.name = b.name "
                "AND a.spec_json = b.spec_json GROUP BY b.id");
    Id ours = 0, theirs = 0;
    while (known.next()) {
      known.get(theirs, ours);
      same[theirs] = ours;
    }
    // Runs that come alone are numbered without gaps.
    std::map<Id, Id> renumbered;
    for (const Id run : std::set<Id>(runs.begin(), runs.end()))
      renumbered[run] = offsets.at("run") + static_cast<Id>(renumbered.size()) + 1;
    const auto moved = [&](const Column& column) {
      const std::string by = column.name + " + " + std::to_string(offsets.at(column.table));
      const std::map<Id, Id> none;
      const std::map<Id, Id>& moves = column.table == "experiment" ? same : column.table == "run" ? renumbered : none;
      if (moves.empty()) return by;
      std::string text = "CASE " + column.name;
      for (const auto& [from, to] : moves) text += " WHEN " + std::to_string(from) + " THEN " + std::to_string(to);
      return text + " ELSE " + by + " END";
    };

    // Versions of a rig that is in both follow behind ours.
    const auto numberInRig = [&] {
      std::string text = "CASE experiment_id";
      for (const auto& [from, to] : same)
        text += " WHEN " + std::to_string(from) + " THEN number + " +
                std::to_string(*Query(c,
                                      "SELECT ifnull(max(number) + 1, 0) FROM main.rig_simulator "
                                      "WHERE experiment_id = ?",
                                      to)
                                    .value<std::int64_t>());
      return same.empty() ? std::string("number") : text + " ELSE number END";
    };

    MergedRuns merged;
    for (const std::string& table : schema.tables()) {
      std::string names, values;
      for (const Column& column : schema.columns(table)) {
        names += (names.empty() ? "" : ", ") + column.name;
        values +=
            (values.empty() ? "" : ", ") + (table == "simulator" && column.name == "evidence" ? movedEvidence(offsets)
                                            : table == "rig_simulator" && column.name == "number" ? numberInRig()
                                            : column.table.empty()                                ? column.name
                                                                                                  : moved(column));
      }
      std::string which = choice.of(table);
      const auto also = [&](const std::string& condition) { which += (which.empty() ? "" : " AND ") + condition; };
      if (table == "experiment")
        for (const auto& [from, to] : same) also("id <> " + std::to_string(from));
      if (table == "trace") also("length(packed) <= " + std::to_string(largestTrace));
      if (!which.empty()) which = " WHERE " + which;
      // Files are shared by content.
      const std::string verb = table == "stored_file" ? "INSERT OR IGNORE INTO main." : "INSERT INTO main.";
      const int count =
          Query(c, (verb + table + " (" + names + ") SELECT " + values + " FROM other." + table + which).c_str()).run();
      if (table == "experiment") merged.experiments = count;
      if (table == "run") merged.runs = count;
      if (table == "individual") merged.individuals = count;
    }
    return merged;
  });
}

}  // namespace btr
