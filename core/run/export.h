#pragma once
#include <string>
#include <vector>

#include "core/store/database.h"

namespace btr {

/// A table of a run as CSV (RFC 4180, a header line, "\n"): `what` is generations, individuals, gaps, simulators,
/// measurements, policies or steps (both of L2). Numbers are the shortest that read back as the same double. The
/// genotype's names (which end in their units) head the parameters of individuals and policies, `fitnessUnit` ends the
/// columns that carry fitness ("m/s" gives best_m_s). The column `reality` says who answered: person or stand_in.
/// Throws InputError for another `what`, an unknown run, or a genotype whose length does not fit.
std::string exportCsv(const Database& database, Id run, const std::string& what,
                      const std::vector<Parameter>& genotype = {}, const std::string& fitnessUnit = "");

/// "_m_s" for "m/s", "_nm" for "N·m", "" for no unit: the end of a column's name.
std::string unitSuffix(const std::string& unit);

}  // namespace btr
