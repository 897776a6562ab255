#include "ui/charts/spec_difference.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <map>

#include "ui/charts/plot_data.h"

namespace btr::ui {
namespace {

using Flat = std::map<QString, QString>;

QString textOf(const QJsonValue& value) {
  if (value.isString()) return value.toString();
  if (value.isDouble()) return exactText(value.toDouble());
  if (value.isBool()) return value.toBool() ? "true" : "false";
  return "null";
}

/// Named members of a list keep their name as key, so that the order of robots or servos does not matter.
QString keyIn(const QJsonArray& array, qsizetype i) {
  const QJsonObject object = array[i].toObject();
  for (const char* name : {"name", "path", "effect"})
    if (object.value(QLatin1String(name)).isString()) return object.value(QLatin1String(name)).toString();
  return QString::number(i + 1);
}

void flatten(const QJsonValue& value, const QString& key, Flat& flat) {
  const auto below = [&](const QString& name) { return key.isEmpty() ? name : key + '.' + name; };
  if (value.isObject()) {
    const QJsonObject object = value.toObject();
    for (auto member = object.begin(); member != object.end(); ++member)
      flatten(member.value(), below(member.key()), flat);
  } else if (value.isArray()) {
    const QJsonArray array = value.toArray();
    const bool plain =
        std::none_of(array.begin(), array.end(), [](const auto& v) { return v.isObject() || v.isArray(); });
    if (plain) {
      // Vectors and lists of words read best in one line.
      QStringList parts;
      for (const auto& element : array) parts << textOf(element);
      flat[key] = '[' + parts.join(", ") + ']';
      return;
    }
    for (qsizetype i = 0; i < array.size(); ++i) flatten(array[i], below(keyIn(array, i)), flat);
  } else {
    flat[key] = textOf(value);
  }
}

void addJson(Flat& flat, const std::string& text, const QString& under) {
  if (text.empty()) return;
  const QJsonDocument document = QJsonDocument::fromJson(QByteArray::fromStdString(text));
  // What cannot be read is still compared, as a whole.
  if (document.isNull())
    flat[under.isEmpty() ? "spec" : under] = QString::fromStdString(text);
  else
    flatten(document.isArray() ? QJsonValue(document.array()) : QJsonValue(document.object()), under, flat);
}

Flat flat(const RunRecord& run) {
  Flat all;
  addJson(all, run.specJson, {});
  addJson(all, run.sceneJson, "scene file");
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
