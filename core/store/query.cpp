#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <bit>
#include <cmath>

#include "core/store/connection.h"

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

void Query::bind(int index, const std::vector<double>& value) {
  std::string bytes;
  bytes.reserve(value.size() * 8);
  for (const double number : value) {
    if (std::isnan(number)) connection_.refuse("a parameter is NaN; NaN cannot be stored");
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
  }
  bind(index, Blob{bytes});
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

void Query::read(int column, std::vector<double>& field) const {
  const std::string bytes = statement_->getColumn(column).getString();
  if (bytes.size() % 8 != 0) connection_.refuse("is damaged: a vector of " + std::to_string(bytes.size()) + " bytes");
  field.resize(bytes.size() / 8);
  for (std::size_t i = 0; i < field.size(); ++i) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 8; ++k) bits |= std::uint64_t{static_cast<unsigned char>(bytes[8 * i + k])} << (8 * k);
    field[i] = std::bit_cast<double>(bits);
  }
}

}  // namespace btr
