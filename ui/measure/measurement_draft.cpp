// Unsaved measurements as text, for the window's settings.
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "ui/measure/measurement_row.h"

namespace btr::ui {

QString toText(const MeasurementDraft& draft) {
  QJsonArray rows;
  for (const auto& [place, edit] : draft) {
    if (edit.isEmpty()) continue;
    QJsonArray values;
    for (const TypedValue& value : edit.values)
      values.append(QJsonObject{{"text", value.text}, {"void", value.isVoid}});
    // A number of JSON is exact up to 2^53 only; as text it always is.
    rows.append(QJsonObject{{"stage", place.first},
                            {"individual", QString::number(place.second)},
                            {"values", values},
                            {"void", edit.isVoid},
                            {"note", edit.note}});
  }
  return rows.isEmpty() ? QString() : QString::fromUtf8(QJsonDocument(rows).toJson(QJsonDocument::Compact));
}

MeasurementDraft draftFromText(const QString& text) {
  MeasurementDraft draft;
  for (const QJsonValue row : QJsonDocument::fromJson(text.toUtf8()).array()) {
    MeasurementEdit edit;
    for (const QJsonValue value : row["values"].toArray())
      edit.values.push_back({value["text"].toString(), value["void"].toBool()});
    edit.isVoid = row["void"].toBool();
    edit.note = row["note"].toString();
    if (const Id individual = row["individual"].toString().toLongLong(); individual > 0 && !edit.isEmpty())
      draft[{row["stage"].toInt(), individual}] = std::move(edit);
  }
  return draft;
}

}  // namespace btr::ui
