#pragma once
#include <QString>
#include <QStringList>

namespace btr::ui {

/// A program that goes on without the window; what it says on standard error is kept in a file while the window is
/// open.
class DetachedProgram {
 public:
  DetachedProgram() = default;
  /// Starts it. `name` is of the file, among those of this window. Empty, or why it cannot be started.
  QString start(const QString& program, const QStringList& arguments, const QString& name);
  /// False before it was started, and once it has ended.
  bool isAlive() const;
  qint64 process() const { return process_; }
  QString words() const;      ///< the end of what it said, trimmed
  QString lastWords() const;  ///< the last line of it, empty if none
  /// Forgets what it said; a process that goes on keeps its open file.
  void forget();

 private:
  qint64 process_ = 0;
  QString log_;
};

/// The last line that is not empty, trimmed; empty if none.
QString lastLine(const QString& text);

/// True while a process with this number is there and has not ended.
bool isProcessAlive(qint64 process);

}  // namespace btr::ui
