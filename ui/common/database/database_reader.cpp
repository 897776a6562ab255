#include "ui/common/database/database_reader.h"

#include <QFileInfo>
#include <QThread>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>

#include "core/spec/error.h"

namespace btr::ui {
namespace {
constexpr int slow_ms = 300;
}

/// The thread and what it has to do. The database is its own; `stop` ends a query early.
class DatabaseReader::Worker final : public QThread {
 public:
  using Answer = std::function<void(quint64, const Value&, std::exception_ptr)>;
  explicit Worker(Answer answer) : answer_(std::move(answer)) { start(); }
  ~Worker() override {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
      stop_ = true;
      queue_.clear();
    }
    wake_.notify_all();
    wait();
  }

  void add(quint64 number, Job job) {
    push(number, [this, job = std::move(job)] {
      if (!database_) throw InputError("No database is open.");
      return job(*database_);
    });
  }
  void addOpening(quint64 number, const std::string& path, Database::Mode mode) {
    push(number, [this, path, mode]() -> Value {
      std::optional<Database> writer;
      if (mode != Database::Mode::readOnly) writer = Database::open(path, mode);
      Database reader = Database::open(path, Database::Mode::readOnly);
      reader.endWhen(stop_);
      database_ = std::move(reader);
      return std::make_shared<std::optional<Database>>(std::move(writer));
    });
  }
  /// It is not begun any more, or ends early.
  void drop(quint64 number) {
    const std::lock_guard lock(mutex_);
    if (running_ == number) stop_ = true;
    std::erase_if(queue_, [&](const Task& waiting) { return waiting.number == number; });
  }

 private:
  struct Task {
    quint64 number;
    std::function<Value()> work;
  };
  void push(quint64 number, std::function<Value()> work) {
    {
      const std::lock_guard lock(mutex_);
      queue_.push_back({number, std::move(work)});
    }
    wake_.notify_all();
  }
  void run() override {
    std::unique_lock lock(mutex_);
    while (true) {
      running_ = 0;
      wake_.wait(lock, [this] { return over_ || !queue_.empty(); });
      if (over_) break;
      const Task task = std::move(queue_.front());
      queue_.pop_front();
      running_ = task.number;
      stop_ = false;
      lock.unlock();
      Value value;
      std::exception_ptr problem;
      try {
        value = task.work();
      } catch (...) {
        problem = std::current_exception();
      }
      answer_(task.number, value, problem);
      lock.lock();
    }
    database_.reset();
  }

  Answer answer_;
  std::atomic<bool> stop_ = false;
  std::optional<Database> database_;  ///< used only by the thread
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> queue_;
  quint64 running_ = 0;
  bool over_ = false;
};

DatabaseReader::DatabaseReader(QObject* parent)
    : QObject(parent),
      worker_(std::make_unique<Worker>([this](quint64 number, const Value& value, const std::exception_ptr& problem) {
        QMetaObject::invokeMethod(
            this, [this, number, value, problem] { answer(number, value, problem); }, Qt::QueuedConnection);
      })) {
  slow_.setSingleShot(true);
  connect(&slow_, &QTimer::timeout, this, &DatabaseReader::tellWaiting);
}

DatabaseReader::~DatabaseReader() { worker_.reset(); }

std::optional<Database> DatabaseReader::open(const QString& path, Database::Mode mode) {
  if (opening_) throw InputError(tr("Another database is just being opened.").toStdString());
  QEventLoop loop;
  Value writer;
  std::exception_ptr problem = std::make_exception_ptr(InputError(path.toStdString() + ": was not opened"));
  opening_ = [&](const Value& value, const std::exception_ptr& why) {
    problem = why;
    writer = value;
    if (!why) forgetAll(path);
    loop.quit();
  };
  const quint64 number = begin({this, {}, tr("the database %1").arg(QFileInfo(path).fileName())});
  worker_->addOpening(number, path.toStdString(), mode);
  loop.exec(QEventLoop::ExcludeUserInputEvents);
  opening_ = {};
  if (problem) std::rethrow_exception(problem);
  return std::move(*static_cast<std::optional<Database>*>(writer.get()));
}

// Another file: what was asked of the one before is of no use.
void DatabaseReader::forgetAll(const QString& path) {
  path_ = path;
  for (const auto& [number, request] : pending_) worker_->drop(number);
  pending_.clear();
}

void DatabaseReader::ask(Request request, Job job) {
  for (auto older = pending_.begin(); older != pending_.end();)
    if (older->second.receiver == request.receiver && older->second.kind == request.kind) {
      worker_->drop(older->first);
      older = pending_.erase(older);
    } else {
      ++older;
    }
  worker_->add(begin(std::move(request)), std::move(job));
}

quint64 DatabaseReader::begin(Request request) {
  request.since.start();
  pending_[++asked_] = std::move(request);
  if (!slow_.isActive()) slow_.start(slow_ms);
  return asked_;
}

void DatabaseReader::answer(quint64 number, const Value& value, const std::exception_ptr& problem) {
  const auto found = pending_.find(number);
  if (found == pending_.end()) return;
  const Request request = std::move(found->second);
  pending_.erase(found);
  if (request.receiver == this)
    opening_(value, problem);
  else if (request.receiver)
    give(request, value, problem);
  if (!told_.isEmpty()) tellWaiting();
  if (isIdle()) emit idle();
}

void DatabaseReader::give(const Request& request, const Value& value, const std::exception_ptr& problem) {
  QString why;
  try {
    if (problem) std::rethrow_exception(problem);
    return request.done(value.get());
  } catch (const std::exception& error) {
    why = QString::fromUtf8(error.what());
  }
  if (request.failed)
    request.failed(why);
  else
    emit failed(why);
}

void DatabaseReader::tellWaiting() {
  QStringList what;
  for (const auto& [number, request] : pending_)
    if (request.since.elapsed() >= slow_ms && !what.contains(request.what)) what << request.what;
  if (!pending_.empty()) slow_.start(slow_ms);
  if (what == told_) return;
  told_ = what;
  emit waiting(told_);
}

void DatabaseReader::waitUntilIdle(QEventLoop::ProcessEventsFlags flags) {
  if (isIdle()) return;
  QEventLoop loop;
  connect(this, &DatabaseReader::idle, &loop, &QEventLoop::quit);
  loop.exec(flags);
}

}  // namespace btr::ui
