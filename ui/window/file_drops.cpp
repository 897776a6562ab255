#include "ui/window/file_drops.h"

#include <QDropEvent>
#include <QMimeData>
#include <QUrl>
#include <QWidget>

#include "core/live/session_log.h"
#include "core/spec/file_kind.h"

namespace btr::ui {
namespace {

QStringList filesIn(const QMimeData& data) {
  QStringList files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  return files;
}

}  // namespace

FileDrops::FileDrops(QWidget& window) : QObject(&window) {
  window.setAcceptDrops(true);
  window.installEventFilter(this);
}

bool FileDrops::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop) return QObject::eventFilter(watched, event);
  // A drag that enters is a drop to come.
  auto* drop = static_cast<QDropEvent*>(event);
  const QStringList files = filesIn(*drop->mimeData());
  if (files.isEmpty()) return false;
  drop->setDropAction(Qt::CopyAction);
  drop->accept();
  if (event->type() == QEvent::Drop) open(files);
  return true;
}

void FileDrops::open(const QStringList& paths) {
  QStringList recordings, unknown;
  for (const QString& path : paths) {
    const std::string plain = path.toStdString();
    switch (kindOfFile(plain)) {
      case FileKind::database:
        emit databaseGiven(path);
        break;
      case FileKind::experiment:
        emit experimentGiven(path);
        break;
      case FileKind::game:
        emit gameGiven(path);
        break;
      case FileKind::scene:
        emit sceneGiven(path);
        break;
      case FileKind::robot:
        emit robotGiven(path);
        break;
      case FileKind::recording:
        recordings << path;
        break;
      case FileKind::report:
        emit reportGiven(path);
        break;
      default:
        if (isSessionLog(plain)) {
          emit sessionGiven(path);
          break;
        }
        unknown << tr("%1 is %2").arg(path, QString::fromStdString(kindInWords(plain)));
    }
  }
  if (!recordings.isEmpty()) emit recordingsGiven(recordings);
  if (!unknown.isEmpty())
    emit refused(tr("%1; the window opens databases, experiments, scenes, games, session logs, robot models, "
                    "recordings (CSV) and the "
                    "folders of gap reports.")
                     .arg(unknown.join("; ")));
}

}  // namespace btr::ui
