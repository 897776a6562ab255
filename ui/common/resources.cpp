#include "ui/common/resources.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>

namespace btr::ui {
namespace {

QStringList filesIn(const QString& kind) {
  const QString resources = resourceDirectory();
  if (resources.isEmpty()) return {};
  QStringList paths;
  const QDir folder(resources + '/' + kind);
  for (const QString& name : folder.entryList({"*.json"}, QDir::Files, QDir::Name)) paths << folder.filePath(name);
  return paths;
}

}  // namespace

QString resourceDirectory() {
  if (const QString named = qEnvironmentVariable("UCHILSIM_RESOURCES"); !named.isEmpty()) return named;
  QDir folder(QCoreApplication::applicationDirPath());
  // bin, the build folder, build, the source: an installed program has share/uchilsim beside bin.
  for (int up = 0; up < 4; ++up) {
    for (const char* name : {"share/uchilsim", "resources"})
      if (folder.exists(QString(name) + "/experiments")) return folder.filePath(name);
    if (!folder.cdUp()) break;
  }
  return {};
}

QStringList exampleExperiments() { return filesIn("experiments"); }
QString exampleName(const QString& path) {
  QFile file(path);
  if (file.open(QIODevice::ReadOnly))
    if (const QString name = QJsonDocument::fromJson(file.readAll())["name"].toString(); !name.isEmpty()) return name;
  return QFileInfo(path).completeBaseName();
}

QString exampleDatabase() {
  const QString resources = resourceDirectory();
  for (const QString& path : {resources + "/experiments.db", resources + "/../experiments.db"})
    if (!resources.isEmpty() && QFileInfo::exists(path)) return QDir::cleanPath(path);
  return {};
}

QStringList exampleGrids() { return filesIn("grids"); }

}  // namespace btr::ui
