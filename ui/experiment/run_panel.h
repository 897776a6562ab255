#pragma once
#include <QWidget>
#include <vector>

#include "ui/experiment/run_text.h"

class QHBoxLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;

namespace btr::ui {

class ShortLabel;

/// One run at a glance: where it is, what comes next, how fast, and the buttons to start, continue and stop it.
class RunPanel : public QWidget {
  Q_OBJECT
 public:
  explicit RunPanel(QWidget* parent = nullptr);
  void showRun(const RunRecord& run, const RunProgress& progress, bool active);
  /// Those of L1 that are stored; while L3 works, its errors stand in the places of best and mean.
  void setGenerations(const std::vector<GenerationRecord>& all);
  void addGenerations(const std::vector<GenerationRecord>& added);
  void setMeasuring(const MeasuringCount& measuring);
  /// Best and mean stay unsaid while somebody measures blind: the best are those who are measured.
  void setBlind(bool blind);
  void clear();
  void setUnit(const QString& unit);  ///< of the fitness
  void setJobs(int jobs);             ///< worker processes, 0: as many as processors
  int jobs() const;
  RunFace face() const { return face_; }

 signals:
  void continueRequested(btr::Id run);
  void stopRequested(btr::Id run);
  void jobsChanged(int jobs);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Figure {
    QLabel *caption, *value;
  };
  Figure addFigure(QHBoxLayout& row, const QString& name, const QString& caption, const QString& toolTip);
  void refresh();

  RunRecord run_;
  RunProgress progress_;
  MeasuringCount measuring_;
  GenerationRecord generation_;  ///< the last one
  GenerationRecord best_;        ///< with the best fitness of all in the newest simulator
  long trials_ = 0;              ///< of all stored generations
  bool active_ = false, empty_ = true, blind_ = false;
  QString shownIcon_;  ///< and its colour
  RunFace face_ = RunFace::ready;
  QString unit_;
  QLabel* icon_;
  ShortLabel *stage_, *name_, *standIn_;  ///< brief where the panel is narrow: its figures come first
  QLabel *next_, *message_;
  QProgressBar *overall_, *within_;
  QPushButton *go_, *stop_;
  QSpinBox* jobs_;
  Figure bestShown_, mean_, speed_, trialsShown_, left_;
};

}  // namespace btr::ui
