#pragma once
#include <QStringList>

#include "ui/gap/program_process.h"

namespace btr::ui {

/// What is to be analysed: paths as the command line takes them.
struct AnalysisJob {
  QString scene;
  QStringList recordings, heldOut;
  QString mapping, simulator, out;  ///< empty: none; out is needed
  int jobs = 0;                     ///< 0: as the program decides
  quint64 seed = 1;
  int within_min = 0;       ///< minutes after which it comes to its end, 0: it takes its time
  bool asRecorded = false;  ///< whatever the doctor is certain of
  bool operator==(const AnalysisJob&) const = default;
};

/// The arguments of "btr gap analyse" for a job.
QStringList argumentsOf(const AnalysisJob& job);

/// Runs "btr gap analyse" beside the window: ends with the report's folder. An analysis that nobody waits for is
/// started with btr itself.
class AnalysisProcess : public ProgramProcess {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit AnalysisProcess(const QString& program = {}, QObject* parent = nullptr);
  void start(const AnalysisJob& job);

 signals:
  void finished(const QString& reportFolder);

 private:
  QString out_;
};

}  // namespace btr::ui
