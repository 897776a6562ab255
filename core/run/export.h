#pragma once
#include <string>
#include <vector>

#include "core/store/database.h"

namespace btr {

/// A table of a run as CSV (RFC 4180, a header line, "\n"): `what` is generations, individuals, gaps, simulators or
/// measurements. Numbers are the shortest that read back as the same double. `parameterNames` heads the parameters of
/// individuals (the genotype's names, which end in their units), `fitnessUnit` ends the columns that carry fitness
/// ("m/s" gives best_m_s). The column `reality` says who answered: person or stand_in.
/// Throws InputError for another `what`, an unknown run, or names whose number does not fit.
std::string exportCsv(const Database& database, Id run, const std::string& what,
                      const std::vector<std::string>& parameterNames = {}, const std::string& fitnessUnit = "");

/// "_m_s" for "m/s", "_nm" for "N·m", "" for no unit: the end of a column's name.
std::string unitSuffix(const std::string& unit);

}  // namespace btr
