#pragma once
#include <QWidget>

#include "ui/measure/measurement_model.h"

class QAction;
class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace btr::ui {

class MessageBanner;
class MeasurementView;
class QuestionBar;

/// The page on which a person enters real fitness: the individuals of a stage in the drawn order, their repeats, notes
/// and falls. It stores nothing: what is saved goes out by submitted() and comes back by setMeasurements().
class MeasurementSheet : public QWidget {
  Q_OBJECT

 public:
  explicit MeasurementSheet(QWidget* parent = nullptr);

  void setUnit(const QString& unit);
  void setAllowed(const AllowedRange& allowed);
  /// Whether the run goes on by itself once its last value is stored; the sheet then asks before it stores that one.
  void setGoesOnByItself(bool goesOn) { goesOnByItself_ = goesOn; }
  /// The stand-in reality answers by itself; the sheet says so.
  void setStandIn(bool standIn);
  /// All tasks of a run, in the order in which its stages and iterations of L2 asked for them. One of these is shown at
  /// a time: the newest, unless the user looks at an earlier one that is still there.
  void setTasks(const std::vector<MeasurementTask>& tasks);
  void showNewest();
  void setMeasurements(const std::vector<MeasurementRecord>& measurements);
  /// Whether the run waits for the newest stage and nobody works on it: only then it can go on.
  void setWaiting(bool waiting);
  /// Unsaved edits that an earlier session has left; the sheet says that they are there again.
  void setDraft(const MeasurementDraft& draft);
  /// An open editor counts as entered.
  void finishEditing();
  /// The store refused what was submitted; it stays in the sheet.
  void submissionFailed(const QString& message);

  void setWho(const QString& who);
  QString who() const;
  MeasurementModel& model() { return model_; }
  MeasurementView& view() { return *view_; }
  /// What the progress line says, "7 of 10 measured, 1 void".
  QString progressText() const;

 public slots:
  /// Submits everything that is entered and readable; otherwise says which cell is not and submits nothing. Values that
  /// are far from what is expected, and the last ones of a stage, are asked about first.
  void save();

 signals:
  void submitted(const std::vector<btr::MeasurementRecord>& records);
  void voidRequested(btr::Id measurement, bool isVoid, const QString& note);
  void replayRequested(btr::Id individual);
  void importRequested();
  /// The parameters of these individuals are wanted: in the clipboard or in a file.
  void parametersRequested(const std::vector<btr::Id>& individuals, bool asFile);
  void continueRequested();

 private:
  QWidget* makeToolBar();
  QWidget* makeFooter();
  void refresh();
  void fillStages(std::size_t shown);
  void showStage(std::size_t index);
  QString title() const;
  bool isNewest() const { return shown_ + 1 == stages_.size(); }
  void askVoid(const QModelIndex& cell);
  bool confirmVoid(const std::vector<MeasurementRecord>& values);
  bool askBeforeSaving();
  void store();
  void sayLeftOut(const QStringList& texts);
  void sayUnclear(const QStringList& texts);
  void editsChanged();
  void clearSaidOfEdit();
  bool completesStage() const;
  QAction* addKey(const QString& text, const char* icon, const QKeySequence& keys);

  MeasurementModel model_;
  MeasurementView* view_;
  MessageBanner* banner_;
  QuestionBar* question_;
  std::vector<std::vector<MeasurementTask>> stages_;  ///< stages and iterations apart
  std::size_t shown_ = 0;
  QComboBox* stage_;
  QLabel* title_;
  QLabel* progressText_;
  QProgressBar* progress_;
  QLineEdit* who_;
  QCheckBox* showSimulated_;
  QPushButton *save_, *continue_;
  QAction *saveAction_ = nullptr, *undo_ = nullptr, *redo_ = nullptr;
  bool standIn_ = false, waiting_ = false;
  bool goesOnByItself_ = false;
  QModelIndex asked_;         ///< the first cell that the question is about
  bool saysRefused_ = false;  ///< the banner is about a value that is not allowed
  bool saysEdit_ = false;     ///< the banner is about the edit that was made last
};

}  // namespace btr::ui
