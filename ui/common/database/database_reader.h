#pragma once
#include <QElapsedTimer>
#include <QEventLoop>
#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QTimer>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>

#include "core/store/database.h"

namespace btr::ui {

/// Reads a database in a thread of its own, with a connection of its own, so that the window never waits for a file: a
/// query goes there as a function, its result comes back as a value. All questions of the window go this way, one after
/// the other in the order in which they were asked. Two kinds do not: replays and new runs have threads and connections
/// of their own, and what a person enters (measured values, notes, "stop") is written by Workbench::writer(), which
/// also reads the few rows that the same action needs: the measurements of the run that was just measured, and the
/// simulator that rested on a value that was just voided.
class DatabaseReader : public QObject {
  Q_OBJECT
 public:
  explicit DatabaseReader(QObject* parent = nullptr);
  /// Ends the query that runs and waits for it; nobody is answered any more.
  ~DatabaseReader() override;

  /// Turns to another file, made or brought up to date first in Mode::create. Returns when it is open; meanwhile the
  /// window is painted and takes no keys and clicks. The connection that made it is handed over for writing (none in
  /// Mode::readOnly). Throws InputError and keeps the old file. What was asked of the old one and is not answered by
  /// then never is.
  std::optional<Database> open(const QString& path, Database::Mode mode);
  bool isOpen() const { return !path_.isEmpty(); }
  QString path() const { return path_; }

  using Failed = std::function<void(const QString& why)>;
  /// Asks `query(database)` and gives its value to `done` in the window's thread, or to `failed` why there is none
  /// (left empty: by the signal); also what `done` throws. Nobody is answered when `receiver` is gone or has asked for
  /// the same `kind` again: a late answer never replaces a newer one, and what nobody waits for any more is not read.
  /// `query` runs in the other thread and must hold only values. `what` says to the user what is waited for.
  template <class Query, class Done>
  void read(QObject* receiver, const QString& kind, const QString& what, Query query, Done done, Failed failed = {}) {
    using Result = std::invoke_result_t<Query, const Database&>;
    ask({receiver, kind, what,
         [done = std::move(done)](void* value) mutable { done(std::move(*static_cast<Result*>(value))); },
         std::move(failed)},
        [query = std::move(query)](const Database& database) -> Value {
          return std::make_shared<Result>(query(database));
        });
  }

  /// Nothing is being read and nobody waits for an answer.
  bool isIdle() const { return pending_.empty(); }
  /// Turns the event loop until everything is answered, also what the answers have led to.
  void waitUntilIdle(QEventLoop::ProcessEventsFlags flags = QEventLoop::AllEvents);

 signals:
  void failed(const QString& why);
  /// What has been waited for longer than is pleasant; none: no longer.
  void waiting(const QStringList& what);
  void idle();

 private:
  using Value = std::shared_ptr<void>;
  using Job = std::function<Value(const Database& database)>;
  struct Request {
    QPointer<QObject> receiver;  ///< this reader's own: a file that is being opened
    QString kind, what;
    std::function<void(void* value)> done = {};
    Failed failed = {};
    QElapsedTimer since = {};
  };
  class Worker;
  void ask(Request request, Job job);
  quint64 begin(Request request);
  void forgetAll(const QString& path);
  void answer(quint64 number, const Value& value, const std::exception_ptr& problem);
  void give(const Request& request, const Value& value, const std::exception_ptr& problem);
  void tellWaiting();

  std::unique_ptr<Worker> worker_;
  QString path_;
  std::map<quint64, Request> pending_;  ///< by number, in the order in which they were asked
  quint64 asked_ = 0;
  std::function<void(const Value& writer, const std::exception_ptr& problem)> opening_;
  QTimer slow_;
  QStringList told_;
};

}  // namespace btr::ui
