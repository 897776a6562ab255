#include "ui/charts/spec_difference.h"

#include <algorithm>
#include <map>

#include "core/run/setup/spec_changes.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {
namespace {

using Flat = std::map<QString, QString>;

QString textOf(const nlohmann::json& value) {
  if (value.is_string()) return QString::fromStdString(value.get<std::string>());
  if (value.is_number()) return exactText(value.get<double>());
  if (!value.is_array()) return QString::fromStdString(value.dump());
  // Vectors and lists of words read best in one line.
  QStringList parts;
  for (const auto& element : value) parts << textOf(element);
  return '[' + parts.join(", ") + ']';
}

Flat flat(const RunRecord& run) {
  Flat all;
  for (const auto& [key, value] : specSettings(run)) all[QString::fromStdString(key)] = textOf(value);
  for (const StoredFile& file : run.files)
    all["file " + QString::fromStdString(file.name)] = QString::fromStdString(file.sha256.substr(0, 12));
  all["seed"] = QString::number(run.seed);
  all["reality"] = run.reality == "stand_in" ? "stand-in reality" : QString::fromStdString(run.reality);
  all["program version"] = QString::fromStdString(run.programVersion);
  return all;
}

// A setting that a specification does not name has its default; what else is missing is not there.
QString missingText(const QString& key) {
  for (const char* part : {"settings.", "stages.", "stand_in."})
    if (key.contains(QLatin1String(part))) return QStringLiteral("(default)");
  return QStringLiteral("–");
}

}  // namespace

std::vector<SpecRow> compareSpecs(const std::vector<RunRecord>& runs) {
  std::map<QString, SpecRow> rows;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const auto& [key, value] : flat(runs[i])) {
      SpecRow& row = rows[key];
      row.key = key;
      while (row.values.size() < static_cast<qsizetype>(runs.size())) row.values << missingText(key);
      row.values[static_cast<qsizetype>(i)] = value;
    }
  std::vector<SpecRow> all;
  for (auto& [key, row] : rows) {
    row.differs =
        std::any_of(row.values.begin(), row.values.end(), [&](auto& value) { return value != row.values[0]; });
    all.push_back(std::move(row));
  }
  return all;
}

QString withoutSeed(const RunRecord& run) {
  QString text;
  for (const auto& [key, value] : flat(run))
    if (key != "seed" && key != "name" && key != "program version") text += key + '=' + value + '\n';
  return text;
}

}  // namespace btr::ui
