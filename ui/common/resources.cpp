#include "ui/common/resources.h"

#include <QCoreApplication>
#include <QDir>

namespace btr::ui {

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

QStringList exampleExperiments() {
  const QString resources = resourceDirectory();
  if (resources.isEmpty()) return {};
  QStringList paths;
  const QDir folder(resources + "/experiments");
  for (const QString& name : folder.entryList({"*.json"}, QDir::Files, QDir::Name)) paths << folder.filePath(name);
  return paths;
}

}  // namespace btr::ui
