#pragma once
#include <QElapsedTimer>
#include <QStandardPaths>
#include <QTimer>
#include <QWidget>

#include "core/sim/scene.h"
#include "ui/common/database/file_state.h"
#include "ui/gap/analysis_process.h"
#include "ui/gap/recording_doctor.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace btr::ui {
class MappingForm;
class RecordingPlot;

/// What is to be analysed: scene, recordings (training or held out) with their mappings, simulator, folder of the
/// report. Starts nothing itself.
class AnalysisSetup : public QWidget {
  Q_OBJECT
 public:
  explicit AnalysisSetup(QWidget* parent = nullptr);

  void setScene(const QString& path);
  QString scene() const;
  /// What was read of it last; no robots and balls if nothing was.
  const SceneSpec& sceneSpec() const { return spec_; }
  const ModelSet& models() const { return models_; }
  /// Files that are there already are not added twice.
  void addRecordings(const QStringList& paths);
  void removeRecording();
  /// Where the report's folder has a report, another one with a number is taken; true then. What was adopted or cited
  /// stays as it was.
  bool keepEarlierReport();
  /// Fills an empty page with the shipped example: a simulated XL330 servo whose recordings hide dry friction, one of
  /// them held out.
  void fillWithExample();
  void setHeldOut(int row, bool heldOut);
  /// Simulators to start from beside the scene as given: names for people and their texts (simulator.json).
  void setSimulators(const QStringList& names, const QStringList& texts);
  QString simulatorText() const;  ///< of the chosen one; empty: the scene as given

  AnalysisJob job() const;  ///< without a simulator
  /// What is missing before it can be started; empty if nothing is.
  QString problem() const;
  void showProgress(const QString& stage, double share);
  /// Where new reports are proposed: beside the database, not among the recordings.
  void setReportBase(const QString& folder) { reportBase_ = folder; }
  void setRunning(bool running);

  MappingForm& mapping() { return *mapping_; }
  RecordingPlot& looks() { return *looks_; }
  QTableWidget& recordings() { return *recordings_; }

 signals:
  void startRequested();
  void cancelRequested();
  void failed(const QString& message);
  void mended(const QString& message);  ///< what failed() reported no longer holds
  void changed();
  void sceneChanged(const QString& path);
  /// Recordings of the database are wanted; these files are to be kept in it.
  void storedRequested();
  void keepRequested(const QStringList& files, const QString& scene);

 private:
  void nameReport();
  QWidget* makeInputs();
  void chooseScene();
  void chooseRecordings();
  void readScene();
  void openMapping();
  QString mappingOf(const QString& recording) const;
  void refresh();
  void askDoctor();
  QStringList files(bool heldOut) const;
  bool recordingsHave(const QString& path) const;
  QString seenHeldOut() const;  ///< a held-out file whose bytes are fitted, too; empty: none

  QLineEdit *scene_, *out_, *seed_;
  QString named_;  ///< the report's folder as this page proposed it last
  QComboBox* simulator_;
  QTableWidget* recordings_;
  MappingForm* mapping_;
  RecordingPlot* looks_;
  QPushButton* example_;
  QLabel *problem_, *doctorSays_;
  QSpinBox* within_;
  QCheckBox* asRecorded_;
  QProgressBar* progress_;
  QPushButton *start_, *cancel_;
  SceneSpec spec_;
  QString sceneProblem_;  ///< why the scene cannot be read, as it was reported
  QString sceneRead_;     ///< that spec_ was read from; what is being typed is another
  ModelSet models_;
  RecordingDoctor doctor_;
  mutable FileDigests digests_;
  QElapsedTimer begun_;
  QTimer tick_;
  QString stageNow_;
  double shareNow_ = 0;
  QString reportBase_ = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  bool certain_ = false;  ///< the doctor: an analysis would refuse these recordings
  bool running_ = false;
};

}  // namespace btr::ui
