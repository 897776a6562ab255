#pragma once
#include <QWidget>

#include "ui/measure/measurement_model.h"

class QAction;
class QCheckBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace btr::ui {

class MessageBanner;
class MeasurementView;

/// The page on which a person enters real fitness: the individuals of a stage in the drawn order, their repeats, notes
/// and falls. It stores nothing: what is saved goes out by submitted() and comes back by setMeasurements().
class MeasurementSheet : public QWidget {
  Q_OBJECT

 public:
  explicit MeasurementSheet(QWidget* parent = nullptr);

  void setUnit(const QString& unit);
  void setAllowed(const AllowedRange& allowed);
  /// The stand-in reality answers by itself; the sheet says so.
  void setStandIn(bool standIn);
  void setTasks(const std::vector<MeasurementTask>& tasks);
  void setMeasurements(const std::vector<MeasurementRecord>& measurements);
  /// Whether the run waits for this stage: only then it can go on.
  void setWaiting(bool waiting);
  /// The store refused what was submitted; it stays in the sheet.
  void submissionFailed(const QString& message);

  void setWho(const QString& who);
  QString who() const;
  MeasurementModel& model() { return model_; }
  MeasurementView& view() { return *view_; }
  /// What the progress line says, "7 of 10 measured, 1 void".
  QString progressText() const;

 public slots:
  /// Submits everything that is entered and readable; otherwise says which cell is not and submits nothing.
  void save();

 signals:
  void submitted(const std::vector<btr::MeasurementRecord>& records);
  void voidRequested(btr::Id measurement, bool isVoid, const QString& note);
  void replayRequested(btr::Id individual);
  void importRequested();
  void continueRequested();

 private:
  QWidget* makeToolBar();
  QWidget* makeFooter();
  void refresh();
  void askVoid(const QModelIndex& cell);
  QAction* addKey(const QString& text, const char* icon, const QKeySequence& keys);

  MeasurementModel model_;
  MeasurementView* view_;
  MessageBanner* banner_;
  QLabel* title_;
  QLabel* progressText_;
  QProgressBar* progress_;
  QLineEdit* who_;
  QCheckBox* showSimulated_;
  QPushButton *save_, *continue_;
  QAction *saveAction_ = nullptr, *undo_ = nullptr, *redo_ = nullptr;
  bool standIn_ = false, waiting_ = false;
};

}  // namespace btr::ui
