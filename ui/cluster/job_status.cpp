#include "ui/cluster/job_status.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>

#include "core/spec/error.h"

namespace btr::ui {
namespace {

QJsonObject documentOf(const QByteArray& json, const char* format, const QString& place) {
  const QJsonObject object = QJsonDocument::fromJson(json).object();
  if (const QString found = object["format"].toString(); found != format)
    throw InputError(place.toStdString(), found.isEmpty() ? "no format" : found.toStdString(), format);
  return object;
}

void takeCommon(JobStatus& status, const QJsonObject& object) {
  status.share = object["share"].toDouble();
  status.secondsLeft = object["seconds_left"].toDouble(-1);
  status.trialsPerSecond = object["trials_per_second"].toDouble();
}

}  // namespace

int JobStatus::count(const QString& state) const {
  return int(std::ranges::count_if(parts, [&](const JobPart& part) { return part.state == state; }));
}

bool JobStatus::isGoing() const { return isWorkedOnHere || count("running") + count("queued") > 0; }

JobStatus arrayStatus(const QByteArray& json) {
  const QJsonObject object = documentOf(json, "uchilsim-array-status-1", "btr array status");
  JobStatus status;
  takeCommon(status, object);
  status.what = object["what"].toString();
  status.into = object["into"].toString();
  status.isSlurms = object["is_slurms"].toBool();
  status.isWorkedOnHere = object["is_worked_on_over_ssh"].toBool();
  for (const QJsonValue& each : object["elements"].toArray()) {
    JobPart part;
    part.name = each["name"].toString();
    part.state = each["state"].toString();
    part.host = each["host"].toString();
    part.share = each["share"].toDouble();
    part.trialsPerSecond = each["trials_per_second"].toDouble();
    part.note = each["note"].toString();
    status.parts.push_back(part);
  }
  return status;
}

JobStatus placesStatus(const QByteArray& json, const QString& file) {
  const QJsonObject object = documentOf(json, "uchilsim-places-1", file);
  JobStatus status;
  status.kind = JobStatus::Kind::ranks;
  takeCommon(status, object);
  status.stage = object["stage"].toString();
  for (const QJsonValue& each : object["hosts"].toArray()) {
    JobPart part;
    part.name = each["host"].toString();
    part.workers = each["workers"].toInt();
    part.pieces = each["pieces"].toInteger();
    part.trials = each["trials"].toInteger();
    part.lost = each["lost"].toInteger() + each["analyses"]["lost"].toInteger();
    if (const double worked_s = each["worked_s"].toDouble(); worked_s > 0)
      part.trialsPerSecond = double(part.trials) / worked_s * part.workers;
    status.parts.push_back(part);
  }
  return status;
}

}  // namespace btr::ui
