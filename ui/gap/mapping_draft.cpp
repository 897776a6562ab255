#include "ui/gap/mapping_draft.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/table/table_preview.h"
#include "core/spec/error.h"
#include "ui/common/numbers/number_entry.h"

namespace btr::ui {
namespace {

using json = nlohmann::ordered_json;

struct MappingTexts {
  Q_DECLARE_TR_FUNCTIONS(MappingForm)
};

bool isSpecial(const std::string& key) {
  constexpr std::array special{"settings", "segments", "resample", "retime",      "lost_rows",
                               "tables",   "from_s",   "until_s",  "between_rows"};
  return std::ranges::find(special, key) != special.end();
}

/// Time that no column has.
bool isCountedTime(const std::string& channel, const json& entry) {
  return channel == "time_s" && entry.is_object() && !entry.contains("column");
}

/// By its name, or by what a column of that number is called.
std::string columnOf(const json& entry) {
  const json& column = entry.at("column");
  return column.is_number() ? numberedColumn(column.get<std::size_t>()) : column.get<std::string>();
}

/// A heading's name and what may be its unit: "t [ms]", "angle (°)", "pos / mm", "speed_deg_s", "current_mA".
struct Heading {
  QString name, unit;
};
std::vector<Heading> readingsOf(const QString& column) {
  static const QRegularExpression bracketed(R"(^(.*?)\s*[\[({]([^\[({]*)[\])}]\s*$)"), divided(R"(^(.*?)\s+/\s+(.*)$)"),
      perSecond(R"(^(.*)_([^_]+)_s$)"), ending(R"(^(.*)_([^_]*)$)");
  std::vector<Heading> readings;
  for (const QRegularExpression* form : {&bracketed, &divided, &perSecond, &ending})
    if (const auto found = form->match(column); found.hasMatch())
      readings.push_back({found.captured(1).trimmed(), found.captured(2).trimmed() + (form == &perSecond ? "/s" : "")});
  return readings;
}

bool isTime(const QString& column) {
  const auto isKnown = [](const QString& name) {
    return QStringList{"time", "t", "timestamp", "seconds"}.contains(name.trimmed().toLower());
  };
  return isKnown(column) ||
         (unitInHeading(column, "time_s") && std::ranges::any_of(readingsOf(column), isKnown, &Heading::name));
}

/// As unitsFor() writes it.
QString unitName(const QString& written) {
  constexpr std::array<std::pair<const char*, const char*>, 13> others{{{"°", "deg"},
                                                                        {"degree", "deg"},
                                                                        {"degrees", "deg"},
                                                                        {"°/s", "deg/s"},
                                                                        {"rpm", "rev/min"},
                                                                        {"rev", "turns"},
                                                                        {"sec", "s"},
                                                                        {"seconds", "s"},
                                                                        {"us", "µs"},
                                                                        {"μs", "µs"},
                                                                        {"nm", "n·m"},
                                                                        {"mnm", "mn·m"},
                                                                        {"percent", "%"}}};
  const QString lower = written.toLower();
  for (const auto& [other, name] : others)
    if (lower == QString::fromUtf8(other)) return QString::fromUtf8(name);
  return lower;
}

}  // namespace

MappingDraft MappingDraft::guess(const QStringList& columns) {
  MappingDraft draft;
  bool hasTime = false;
  for (const QString& column : columns) {
    if (!hasTime && isTime(column)) {
      const QString scale = QString::fromStdString(toText(unitInHeading(column, "time_s").value_or(1)));
      draft.rows.insert(draft.rows.begin(), {"time_s", column, scale, "0", false});
      hasTime = true;
    } else if (parseChannel(column.toStdString())) {
      draft.rows.push_back({column, column, "1", "0", false});
    }
  }
  if (!hasTime) draft.rows.insert(draft.rows.begin(), {"time_s", "", "1", "0", false});
  return draft;
}

MappingDraft MappingDraft::fromJson(const std::string& text, const std::string& place) {
  mappingFromJson(text, place);  // the program's own reader judges it
  MappingDraft draft;
  draft.base = text;
  const auto document = json::parse(text);
  for (const auto& [channel, entry] : document.items()) {
    if (isSpecial(channel)) continue;
    if (isCountedTime(channel, entry)) {
      draft.countsTime = true;
      continue;
    }
    const double scale = entry.value("scale", 1.0);
    draft.rows.push_back({QString::fromStdString(channel), QString::fromStdString(columnOf(entry)),
                          QString::fromStdString(toText(std::abs(scale))),
                          QString::fromStdString(toText(entry.value("offset", 0.0))), scale < 0});
  }
  return draft;
}

std::string MappingDraft::toJson() const {
  const auto old = json::parse(base);
  json document = json::object();
  for (const MappingRow& row : rows) {
    const std::string channel = row.channel.trimmed().toStdString();
    json entry = old.contains(channel) ? old.at(channel) : json::object();
    entry["column"] = row.column.toStdString();
    entry["scale"] = (row.flipped ? -1 : 1) * readNumber(row.scale).value.value_or(1);
    entry["offset"] = readNumber(row.offset).value.value_or(0);
    document[channel] = entry;
  }
  for (const auto& [key, value] : old.items())
    if (isSpecial(key) || isCountedTime(key, value)) document[key] = value;
  return document.dump(2) + "\n";
}

MappingProblems problemsOf(const MappingDraft& draft, const QStringList& columns) {
  MappingProblems problems;
  std::set<QString> taken;
  bool hasTime = draft.countsTime;
  for (int i = 0; i < int(draft.rows.size()); ++i) {
    const MappingRow& row = draft.rows[std::size_t(i)];
    const QString channel = row.channel.trimmed();
    const auto wrong = [&](MappingField field, const QString& text) { problems[{i, field}] = text; };
    hasTime = hasTime || channel == "time_s";
    if (channel.isEmpty())
      wrong(MappingField::channel, MappingTexts::tr("A channel is needed, for example leg.knee.position_rad"));
    else if (channel != "time_s" && !parseChannel(channel.toStdString()))
      wrong(MappingField::channel,
            MappingTexts::tr("%1 is not allowed; time_s, ROBOT.JOINT.QUANTITY, ROBOT.base.QUANTITY or BALL.QUANTITY")
                .arg(channel));
    else if (!taken.insert(channel).second)
      wrong(MappingField::channel, MappingTexts::tr("%1 is there twice").arg(channel));
    if (!columns.contains(row.column))
      wrong(MappingField::column, row.column.isEmpty() ? MappingTexts::tr("Choose a column of the file")
                                                       : MappingTexts::tr("The file has no column %1").arg(row.column));
    const auto scale = readNumber(row.scale).value, offset = readNumber(row.offset).value;
    if (!scale || *scale <= 0 || *scale > 1e12)
      wrong(MappingField::scale,
            MappingTexts::tr("%1 is not allowed; a number above 0 (Flip turns the sign)").arg(row.scale));
    else if (channel == "time_s" && row.flipped)
      wrong(MappingField::scale, MappingTexts::tr("Time cannot run backwards: Flip is not allowed here"));
    if (!offset || std::abs(*offset) > 1e12)
      wrong(MappingField::offset,
            MappingTexts::tr("%1 is not allowed; a number in the channel's unit").arg(row.offset));
  }
  if (!hasTime)
    problems[{-1, MappingField::channel}] = MappingTexts::tr("time_s is missing: it names the column of time");
  return problems;
}

std::vector<std::pair<QString, double>> unitsFor(const QString& channel) {
  using std::numbers::pi;
  const auto ends = [&](const char* ending) { return channel.endsWith(QLatin1String(ending)); };
  if (channel == "time_s") return {{"s", 1}, {"ms", 1e-3}, {"µs", 1e-6}, {"ns", 1e-9}};
  if (ends("_rad_s")) return {{"rad/s", 1}, {"deg/s", pi / 180}, {"rev/min", pi / 30}, {"mrad/s", 1e-3}};
  if (ends("_rad"))
    return {{"rad", 1}, {"deg", pi / 180}, {"mrad", 1e-3}, {"turns", 2 * pi}, {"4096 steps", pi / 2048}};
  if (ends("_m_s")) return {{"m/s", 1}, {"cm/s", 1e-2}, {"mm/s", 1e-3}};
  if (ends("_nm")) return {{"N·m", 1}, {"mN·m", 1e-3}, {"kgf·cm", 0.0980665}};
  if (ends("_m")) return {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}};
  if (ends("_n")) return {{"N", 1}, {"mN", 1e-3}};
  if (ends("_v")) return {{"V", 1}, {"mV", 1e-3}};
  if (ends("_a")) return {{"A", 1}, {"mA", 1e-3}};
  if (ends("duty")) return {{"1", 1}, {"%", 1e-2}};
  return {{"1", 1}};
}

std::optional<double> unitInHeading(const QString& column, const QString& channel) {
  for (const Heading& reading : readingsOf(column))
    for (const auto& [name, factor] : unitsFor(channel))
      if (name.toLower() == unitName(reading.unit)) return factor;
  return {};
}

CsvPreview previewCsv(const QString& path) {
  CsvPreview preview;
  for (const TablePreview::Column& column : previewTable(path.toStdString()).columns) {
    preview.columns << QString::fromStdString(column.name);
    preview.ranges.emplace_back(column.low, column.high);
  }
  return preview;
}

}  // namespace btr::ui
