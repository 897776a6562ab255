#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/spec/error.h"

namespace SQLite {
class Database;
class Statement;
}  // namespace SQLite

namespace btr {

struct Cell;

/// One open database file, used only by core/store. What SQLite reports comes out as one InputError that names the
/// file.
class Connection {
 public:
  Connection(std::string path, std::unique_ptr<SQLite::Database> database, int patience_ms);
  ~Connection();

  const std::string& path() const { return path_; }
  SQLite::Database& database() const { return *database_; }
  int patience_ms() const { return patience_ms_; }  ///< how long a call waits for another process's lock
  /// Number that changes with every commit, our own included.
  std::int64_t dataVersion() const;
  /// See Database::endWhen().
  void endWhen(const std::atomic<bool>& stop);

  /// Runs `work` on one snapshot: several queries see the same state.
  template <class Work>
  auto read(const Work& work) const {
    return run(work, false);
  }
  /// Runs `work` in one transaction: all is stored when it returns, nothing when it throws.
  template <class Work>
  auto write(const Work& work) const {
    return run(work, true);
  }
  /// What `work` returns; an InputError of it gets the path in front.
  template <class Work>
  auto unpacked(const Work& work) const {
    try {
      return work();
    } catch (const InputError& error) {
      refuse(error.what());
    }
  }
  /// Throws InputError "PATH: MESSAGE".
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  template <class Work>
  auto run(const Work& work, bool writes) const {
    using Result = std::invoke_result_t<Work>;
    if constexpr (std::is_void_v<Result>) {
      transact(work, writes);
    } else {
      std::optional<Result> result;
      transact([&] { result.emplace(work()); }, writes);
      return std::move(*result);
    }
  }
  void transact(const std::function<void()>& work, bool writes) const;

  std::string path_;
  std::unique_ptr<SQLite::Database> database_;
  int patience_ms_;
  const std::atomic<bool>* stop_ = nullptr;
};

/// What SQLite's latest error on this file means to a person, beginning with the path.
std::string explain(const std::string& path, SQLite::Database* database, int extendedCode, const std::string& message);

/// Bytes rather than text.
struct Blob {
  const std::string& bytes;
};
/// Id 0 is stored as NULL.
struct Reference {
  std::int64_t id;
};

/// One SQL statement: values in, rows out, both in the order of the columns.
/// −0 is stored as 0 (SQLite does not keep the sign), NaN is refused.
class Query {
 public:
  template <class... Values>
  Query(const Connection& connection, const char* sql, const Values&... values) : Query(connection, sql) {
    bindAll(values...);
  }
  Query(const Connection& connection, const char* sql);
  ~Query();

  /// The next row, if there is one.
  bool next();
  /// Runs a statement without rows with these values; may be called again. Returns the number of changed rows.
  template <class... Values>
  int run(const Values&... values) {
    bindAll(values...);
    return execute();
  }
  /// Back to before the first row.
  void reset();
  /// Values for the statement's parameters, in their order.
  template <class... Values>
  void bindAll(const Values&... values) {
    int index = 0;
    (bind(++index, values), ...);
  }
  /// The columns of the current row.
  template <class... Fields>
  void get(Fields&... fields) const {
    int column = 0;
    (read(column++, fields), ...);
  }
  /// The first column of the first row, if any.
  template <class Field>
  std::optional<Field> value() {
    if (!next()) return {};
    Field field{};
    read(0, field);
    return field;
  }

 private:
  int execute();
  void bind(int index, int value);
  void bind(int index, bool value);
  void bind(int index, std::int64_t value);
  void bind(int index, std::uint64_t value);  ///< the same 64 bits
  void bind(int index, double value);
  void bind(int index, const std::optional<double>& value);
  void bind(int index, const std::string& value);
  void bind(int index, const char* value);
  void bind(int index, const Blob& value);
  void bind(int index, const Reference& value);
  void bind(int index, const Cell& value);
  void bind(int index, const std::vector<double>& value);  ///< bytes of little-endian doubles
  void read(int column, int& field) const;
  void read(int column, bool& field) const;
  void read(int column, std::int64_t& field) const;  ///< NULL is 0
  void read(int column, std::uint64_t& field) const;
  void read(int column, double& field) const;
  void read(int column, std::optional<double>& field) const;
  void read(int column, std::string& field) const;
  void read(int column, Cell& field) const;
  void read(int column, std::vector<double>& field) const;

  const Connection& connection_;
  std::unique_ptr<SQLite::Statement> statement_;
};

}  // namespace btr
