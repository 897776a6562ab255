#pragma once
#include <QString>
#include <QStringList>
#include <vector>

#include "core/store/records.h"

namespace btr::ui {

/// One setting of several runs, side by side.
struct SpecRow {
  QString key;         ///< "learner.settings.population"
  QStringList values;  ///< one a run, "–" where a run does not have it
  bool differs = false;
};

/// Every setting of the runs' specs and scenes, and seed, reality and program version, by key.
std::vector<SpecRow> compareSpecs(const std::vector<RunRecord>& runs);

/// Equal for runs that differ in nothing but the seed (their spec's name and description aside).
QString withoutSeed(const RunRecord& run);

}  // namespace btr::ui
