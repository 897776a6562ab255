#pragma once
#include <QWidget>

#include "core/run/reality/fitness_clues.h"
#include "ui/gap/program_process.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace btr::ui {

/// What the measured fitness of a run says of missing physics while there is no recording: which effects would explain
/// the differences, how strongly, and which recording would settle it.
class CluesView : public QWidget {
  Q_OBJECT
 public:
  enum Column { effect, at, share, pValue, sizes, columns };

  /// `program`: empty means btr beside this executable.
  explicit CluesView(const QString& program = {}, QWidget* parent = nullptr);

  /// `measured`: how many of the run's individuals have real fitness. Another run takes the old answer away.
  void setRun(const QString& database, Id run, int measured);
  void setClues(const FitnessClues& clues);
  ProgramProcess& process() { return process_; }

 signals:
  void failed(const QString& message);

 private:
  void ask();
  void refresh();

  QString database_;
  Id run_ = 0;
  int measured_ = 0;
  ProgramProcess process_;
  QLabel *state_, *sentence_;
  QPushButton *ask_, *cancel_;
  QProgressBar* progress_;
  QTableWidget* table_;
};

}  // namespace btr::ui
