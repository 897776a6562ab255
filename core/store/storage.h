#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace btr {

/// What a database file's bytes are used for, each table with its indices, from SQLite's own account of pages (dbstat).
/// Reads the whole file. Throws InputError where it cannot be opened.
std::map<std::string, std::int64_t> storedBytes(const std::string& path);

}  // namespace btr
