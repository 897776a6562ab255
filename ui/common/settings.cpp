#include "ui/common/settings.h"

#include <QCryptographicHash>
#include <QFileInfo>
#include <QVariant>

namespace btr::ui {
namespace {

QString keyOf(const QString& database) {
  const auto digest =
      QCryptographicHash::hash(QFileInfo(database).absoluteFilePath().toUtf8(), QCryptographicHash::Sha1);
  return QString::fromLatin1(digest.toHex().left(16));
}

QString runKey(const QString& database) { return "selectedRun/" + keyOf(database); }

QString draftKey(const QString& database, qint64 run) {
  return QStringLiteral("measured/%1-%2").arg(keyOf(database)).arg(run);
}

}  // namespace

Settings::Settings(const QString& file)
    : store_(file.isEmpty() ? QSettings(QSettings::IniFormat, QSettings::UserScope, "uchilsim", "uchilsim").fileName()
                            : file,
             QSettings::IniFormat) {}

QByteArray Settings::geometry() const { return store_.value("window/geometry").toByteArray(); }

QByteArray Settings::layout() const {
  if (store_.value("window/layoutVersion").toInt() != layoutVersion) return {};
  return store_.value("window/layout").toByteArray();
}

void Settings::setWindow(const QByteArray& geometry, const QByteArray& layout) {
  store_.setValue("window/geometry", geometry);
  store_.setValue("window/layout", layout);
  store_.setValue("window/layoutVersion", layoutVersion);
  store_.sync();
}

Look Settings::look() const { return lookFromText(store_.value("look").toString()); }
void Settings::setLook(Look look) { store_.setValue("look", nameOf(look)); }

QStringList Settings::recentDatabases() const {
  QStringList existing;
  for (const QString& path : store_.value("recent").toStringList())
    if (QFileInfo::exists(path)) existing << path;
  return existing;
}

void Settings::addRecentDatabase(const QString& path) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList all = recentDatabases();
  all.removeAll(absolute);
  all.prepend(absolute);
  store_.setValue("recent", QStringList(all.mid(0, 8)));
}

qint64 Settings::selectedRun(const QString& database) const { return store_.value(runKey(database)).toLongLong(); }
void Settings::setSelectedRun(const QString& database, qint64 run) { store_.setValue(runKey(database), run); }

std::map<qint64, QString> Settings::experimentNames(const QString& database) const {
  std::map<qint64, QString> names;
  const QVariantMap stored = store_.value("experimentNames/" + keyOf(database)).toMap();
  for (const auto& [id, name] : stored.asKeyValueRange()) names[id.toLongLong()] = name.toString();
  return names;
}

void Settings::setExperimentName(const QString& database, qint64 experiment, const QString& name) {
  const QString key = "experimentNames/" + keyOf(database);
  QVariantMap names = store_.value(key).toMap();
  if (name.isEmpty())
    names.remove(QString::number(experiment));
  else
    names[QString::number(experiment)] = name;
  store_.setValue(key, names);
}

std::set<qint64> Settings::archived(const QString& database) const {
  std::set<qint64> ids;
  for (const QString& id : store_.value("archived/" + keyOf(database)).toStringList()) ids.insert(id.toLongLong());
  return ids;
}

void Settings::setArchived(const QString& database, const std::set<qint64>& experiments) {
  QStringList ids;
  for (const qint64 id : experiments) ids << QString::number(id);
  store_.setValue("archived/" + keyOf(database), ids);
}

QString Settings::draft() const { return store_.value("draft/json").toString(); }
QString Settings::draftFolder() const { return store_.value("draft/folder").toString(); }
void Settings::setDraft(const QString& json, const QString& folder) {
  store_.setValue("draft/json", json);
  store_.setValue("draft/folder", folder);
}

QVariantMap Settings::draftRefused() const { return store_.value("draft/refused").toMap(); }
void Settings::setDraftRefused(const QVariantMap& texts) { store_.setValue("draft/refused", texts); }

QString Settings::measurementDraft(const QString& database, qint64 run) const {
  return store_.value(draftKey(database, run)).toString();
}

void Settings::setMeasurementDraft(const QString& database, qint64 run, const QString& draft) {
  if (draft.isEmpty())
    store_.remove(draftKey(database, run));
  else
    store_.setValue(draftKey(database, run), draft);
  // At once: what was typed beside the robot outlives a crash.
  store_.sync();
}

QString Settings::lastGame() const { return store_.value("live/lastGame").toString(); }
void Settings::setLastGame(const QString& file) {
  store_.setValue("live/lastGame", QFileInfo(file).absoluteFilePath());
}

int Settings::jobs() const { return store_.value("jobs", 0).toInt(); }
void Settings::setJobs(int jobs) { store_.setValue("jobs", jobs); }

bool Settings::flag(const QString& name, bool byDefault) const {
  return store_.value("flags/" + name, byDefault).toBool();
}
void Settings::setFlag(const QString& name, bool value) { store_.setValue("flags/" + name, value); }

}  // namespace btr::ui
