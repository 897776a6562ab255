#pragma once
#include <QObject>
#include <QProcess>
#include <QTimer>
#include <functional>

#include "ui/cluster/job_status.h"
#include "ui/experiment/detached_program.h"

namespace btr::ui {

/// What is to be worked on, and where.
struct MachinesOrder {
  enum class Way { ssh, slurm, ranks };
  Way way = Way::ssh;
  QString file;      ///< a comparison or a grid; ranks of MPI also work on an experiment
  QString database;  ///< that gets the results
  QString folder;    ///< of the job, new or empty
  QString hosts;     ///< as people write them, one a line; ranks: may be empty, this machine
  QString options;   ///< of sbatch, one a line or with spaces between them
  int ranks = 2;
  int workers = 1;  ///< worker processes of each element or rank
};

/// Why an order cannot be given, in one sentence; empty if it can.
QString objectionTo(const MachinesOrder& order);

/// A job on several machines: begun, followed, cancelled, resumed and collected by btr, in processes of their own that
/// outlive the window. One job at a time is looked at; others go on.
class MachinesController : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit MachinesController(const QString& program = {}, QObject* parent = nullptr);
  ~MachinesController() override;

  /// Begins a job and follows it. False, with told(), if it cannot be.
  bool start(const MachinesOrder& order);
  /// Follows the job in a folder.
  void open(const QString& folder);
  /// What has been done is kept.
  void cancel();
  /// Works again on what failed, was stopped or has not begun, alone. `hosts`: over ssh; a job of Slurm's may go there,
  /// too. Ranks go on where the database is.
  void resume(const QString& hosts);
  /// Brings what is done into the job's database.
  void collect();

  QString folder() const { return folder_; }
  const JobStatus& status() const { return status_; }
  bool isKnown() const { return known_; }     ///< a status of the job that is followed has come
  bool isGoing() const;                       ///< somebody works on it
  bool isAsked() const { return busy_ > 0; }  ///< what was asked last is being done
  QString hosts() const;                      ///< of the job that is followed, as people write them
  /// Asks now how the job is.
  void poll();

 signals:
  void changed();
  /// A sentence for the user; `isProblem`: something did not work.
  void told(const QString& sentence, bool isProblem);
  void collected(const QString& database);

 private:
  void follow(const QString& folder);
  bool startArray(const MachinesOrder& order);
  bool startRanks(const MachinesOrder& order);
  bool goRanks();
  bool launch(const QString& program, const QStringList& arguments);
  /// Of a command that has ended.
  struct Answer {
    int code;  ///< its exit code; negative: it was killed
    QByteArray out;
    QString lastWords;  ///< the last line on standard error
  };
  void run(const QStringList& arguments, const std::function<void(const Answer&)>& ended,
           const std::function<void()>& notStarted);
  void ask(const QStringList& arguments, const std::function<void(const QByteArray&)>& done);
  void readPlaces();
  void take(const JobStatus& status);
  void noticeEnd();
  bool isRanks() const;
  QString path(const char* name) const;

  QString program_, folder_;
  QString hostsFile_;  ///< of the command that works over ssh; removed when it has ended
  JobStatus status_;
  bool known_ = false, asking_ = false;
  int busy_ = 0, generation_ = 0;  ///< of what is followed: answers about another folder come too late
  DetachedProgram work_;           ///< ssh or ranks
  bool working_ = false;           ///< its end was not seen yet
  QString said_, complaint_;       ///< what was told last of its words; of the status
  QTimer timer_;
};

}  // namespace btr::ui
