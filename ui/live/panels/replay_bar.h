#pragma once
#include <QFrame>
#include <optional>

#include "ui/live/live_process.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QToolButton;

namespace btr::ui {
class ActTimeline;
class ShortLabel;

/// What a session's log that is played again shows: where in time it is, what was done when, whether the bits are the
/// same; and how to leave it. Says what was chosen and shows what it is told.
class ReplayBar : public QFrame {
  Q_OBJECT
 public:
  explicit ReplayBar(QWidget* parent = nullptr);

  /// Another log: `file` is its path.
  void begin(const QString& file);
  void showLog(const LiveLog& log, double period_s);
  void showRow(const LiveRow& row);
  /// The next act after where it is, or the last one before; nothing if there is none.
  void chooseAct(bool next);
  /// So many seconds on or back.
  void chooseTime(double by_s);
  void chooseEnd(bool last);

 signals:
  void jumpWanted(long period);
  void goOnWanted();

 private:
  QString sameness(const LiveRow& row) const;
  void jump(long period);

  LiveLog log_;
  double period_s_ = 1;
  long at_ = 0;
  ActTimeline* line_;
  QToolButton *before_, *after_;
  QDoubleSpinBox* time_;
  ShortLabel *what_, *last_;
  QLabel* same_;
  QPushButton* goOn_;
};

}  // namespace btr::ui
