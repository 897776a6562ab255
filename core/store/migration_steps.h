#pragma once
#include <string>

namespace SQLite {
class Database;
}

// The steps of migrations.cpp that stand in files of their own, and what steps share.
namespace btr {

/// From now on the database itself refuses `event` (UPDATE, DELETE, UPDATE OF …) on rows of `table` where `when` (or
/// always), whichever program asks.
void keep(SQLite::Database& database, const std::string& table, const std::string& event, const std::string& when);

/// Policies of L2 and how its learner goes on.
void learningInReality(SQLite::Database& database);
/// Grids of experiments, their cells and what becomes of them.
void gridsOfExperiments(SQLite::Database& database);

/// Why an individual is measured, the held-out gap's error, and that a person ended L2.
void reasonsForMeasuring(SQLite::Database& database);

/// From which measured values the errors of L3's candidates come.
void evidenceOfAdaptations(SQLite::Database& database);

/// Simulator versions of scenes that no run belongs to.
void simulatorsOfRigs(SQLite::Database& database);

/// Bits, hashes, parameters, recordings and files in fewer bytes; of learners' states only the latest.
void packedRows(SQLite::Database& database);

/// Runs and measurements take any name of who enters real fitness.
void realitiesOfAnyName(SQLite::Database& database);

}  // namespace btr
