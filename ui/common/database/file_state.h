#pragma once
#include <QByteArray>
#include <QMap>
#include <QString>

namespace btr::ui {

/// Changes with the file's content, as far as its folder tells: path, size, time of the last change.
QString fileState(const QString& path);

/// SHA-256 of files that are asked for again and again while a form is filled in: read again only where fileState()
/// changed.
class FileDigests {
 public:
  /// Of a file that cannot be read: its path, which is no other file's digest.
  QByteArray of(const QString& path);

 private:
  QMap<QString, QByteArray> known_;
};

}  // namespace btr::ui
