#include "ui/common/database/file_state.h"

#include <QCryptographicHash>
#include <QDateTime>
#include <QFile>
#include <QFileInfo>

namespace btr::ui {

QString fileState(const QString& path) {
  const QFileInfo info(path);
  return path + '\n' + QString::number(info.size()) + '\n' + QString::number(info.lastModified().toMSecsSinceEpoch()) +
         '\n';
}

QByteArray FileDigests::of(const QString& path) {
  const QString state = fileState(path);
  if (const auto found = known_.constFind(state); found != known_.constEnd()) return *found;
  QFile file(path);
  QCryptographicHash hash(QCryptographicHash::Sha256);
  if (!file.open(QIODevice::ReadOnly) || !hash.addData(&file)) return path.toUtf8();
  return *known_.insert(state, hash.result());
}

}  // namespace btr::ui
