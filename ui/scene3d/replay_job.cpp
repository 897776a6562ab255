#include "ui/scene3d/replay_job.h"

#include <exception>

namespace btr::ui {

/// One run of the work; its result may be read once the thread has ended.
class ReplayJob::Worker final : public QThread {
 public:
  explicit Worker(Work work) : work_(std::move(work)) {}
  ReplayData data;
  QString problem;

 private:
  void run() override {
    try {
      data = work_();
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    } catch (...) {
      problem = tr("The replay failed for an unknown reason.");
    }
  }
  Work work_;
};

ReplayJob::ReplayJob(QObject* parent) : QObject(parent) {}

ReplayJob::~ReplayJob() {
  if (!thread_) return;
  thread_->disconnect(this);
  thread_->requestInterruption();
  thread_->wait();
}

void ReplayJob::start(Work work) {
  next_ = std::move(work);
  if (thread_) {
    dropped_ = true;
    thread_->requestInterruption();
  } else {
    startNext();
  }
}

void ReplayJob::cancel() {
  next_ = nullptr;
  if (!thread_) return;
  dropped_ = true;
  thread_->requestInterruption();
}

void ReplayJob::startNext() {
  dropped_ = false;
  thread_ = std::make_unique<Worker>(std::exchange(next_, nullptr));
  connect(thread_.get(), &QThread::finished, this, &ReplayJob::workEnded);
  thread_->start();
  emit started();
}

void ReplayJob::workEnded() {
  thread_->wait();
  const std::unique_ptr<Worker> ended = std::move(thread_);
  const bool wanted = !dropped_;
  if (next_) startNext();
  if (!wanted) return;
  if (ended->problem.isEmpty())
    emit finished(ended->data);
  else
    emit failed(ended->problem);
}

}  // namespace btr::ui
