#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <bit>
#include <cmath>

#include "core/spec/error.h"
#include "core/store/connection.h"
#include "core/store/packing.h"

namespace btr {

Query::Query(const Connection& connection, const char* sql)
    : connection_(connection), statement_(std::make_unique<SQLite::Statement>(connection.database(), sql)) {}

Query::~Query() = default;

bool Query::next() { return statement_->executeStep(); }

void Query::reset() { statement_->reset(); }

int Query::execute() {
  const int changed = statement_->exec();
  statement_->reset();
  return changed;
}

void Query::bind(int index, int value) { statement_->bind(index, value); }
void Query::bind(int index, bool value) { statement_->bind(index, value ? 1 : 0); }
void Query::bind(int index, std::int64_t value) { statement_->bind(index, value); }
void Query::bind(int index, std::uint64_t value) { statement_->bind(index, std::bit_cast<std::int64_t>(value)); }
void Query::bind(int index, double value) {
  if (std::isnan(value)) connection_.refuse("a number is NaN; NaN cannot be stored");
  statement_->bind(index, value);
}
void Query::bind(int index, const std::optional<double>& value) {
  if (value) {
    bind(index, *value);
  } else {
    statement_->bind(index);
  }
}
void Query::bind(int index, const std::string& value) { statement_->bind(index, value); }
void Query::bind(int index, const char* value) { statement_->bind(index, value); }
void Query::bind(int index, const Blob& value) {
  statement_->bind(index, static_cast<const void*>(value.bytes.data()), static_cast<int>(value.bytes.size()));
}
void Query::bind(int index, const Reference& value) {
  if (value.id != 0) {
    statement_->bind(index, value.id);
  } else {
    statement_->bind(index);
  }
}

void Query::bind(int index, const Cell& value) {
  switch (value.type) {
    case Cell::Type::null:
      return statement_->bind(index);
    case Cell::Type::integer:
      return statement_->bind(index, value.number);
    case Cell::Type::text:
      return statement_->bind(index, value.bytes);
    case Cell::Type::blob:
      return bind(index, Blob{value.bytes});
  }
}

void Query::bind(int index, const std::vector<double>& value) {
  for (const double number : value)
    if (std::isnan(number)) connection_.refuse("a parameter is NaN; NaN cannot be stored");
  bind(index, Blob{bytesOf(value)});
}

void Query::read(int column, int& field) const { field = statement_->getColumn(column).getInt(); }
void Query::read(int column, bool& field) const { field = statement_->getColumn(column).getInt() != 0; }
void Query::read(int column, std::int64_t& field) const { field = statement_->getColumn(column).getInt64(); }
void Query::read(int column, std::uint64_t& field) const {
  field = std::bit_cast<std::uint64_t>(std::int64_t{statement_->getColumn(column).getInt64()});
}
void Query::read(int column, double& field) const { field = statement_->getColumn(column).getDouble(); }
void Query::read(int column, std::optional<double>& field) const {
  const SQLite::Column value = statement_->getColumn(column);
  field = value.isNull() ? std::nullopt : std::optional(value.getDouble());
}
void Query::read(int column, std::string& field) const { field = statement_->getColumn(column).getString(); }

void Query::read(int column, Cell& field) const {
  const SQLite::Column value = statement_->getColumn(column);
  field = {};
  if (value.isInteger()) field = {Cell::Type::integer, value.getInt64(), ""};
  if (value.isText()) field = {Cell::Type::text, 0, value.getString()};
  if (value.isBlob()) field = {Cell::Type::blob, 0, value.getString()};
}

void Query::read(int column, std::vector<double>& field) const {
  try {
    field = doublesOf(statement_->getColumn(column).getString());
  } catch (const InputError& error) {
    connection_.refuse(error.what());
  }
}

}  // namespace btr
