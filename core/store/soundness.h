#pragma once
#include <string>

namespace SQLite {
class Database;
}

namespace btr {

/// Files up to this size are read whole whenever they are opened.
inline constexpr long long readWhole_bytes = 32LL << 20;

/// Why a database cannot be worked with; empty: nothing speaks against it. A file of at most readWhole_bytes is checked
/// page by page (quick_check). Of a larger one so are the tables that say what there is (experiments, runs,
/// generations, measurements, …); of those that hold the mass (individuals, traces, recordings, files, L3's candidates)
/// rows at regular distances are read, and of individuals looked up in their index. The rest shows when it is read, and
/// Database::findings() reads all of it. Throws SQLite::Exception.
std::string whyNotSound(SQLite::Database& database, long long wholeUpTo_bytes = readWhole_bytes);

}  // namespace btr
