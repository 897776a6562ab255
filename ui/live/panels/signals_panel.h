#pragma once
#include <QMap>
#include <QTimer>
#include <QWidget>
#include <vector>

#include "ui/charts/plot_data.h"
#include "ui/live/signal_record.h"

class QDoubleSpinBox;
class QLabel;
class QSplitter;
class QTableWidget;
class QToolButton;

namespace btr::ui {
class LiveWorld;
class PlotWidget;
class SignalPicker;
struct LiveSamples;

/// Signals of the running world over time, every control period of them: up to 20 at once, one plot a unit, their
/// values at the cursor, exported as a recording.
class SignalsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SignalsPanel(LiveWorld& world, QWidget* parent = nullptr);

  SignalPicker& picker() { return *picker_; }
  const SignalRecord& record() const { return record_; }
  /// By unit; "" for those without.
  PlotWidget* plot(const QString& unit) const { return plots_.value(unit); }
  /// A line at the present time in every plot.
  void mark(const QString& label);
  /// Throws InputError.
  void exportTo(const QString& path) const;
  /// What the timer does ten times a second.
  void draw();

 signals:
  void problem(const QString& why);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* makeBar();
  void choose();
  void take(const LiveSamples& samples);
  void clear();
  void exportWithDialog();
  PlotData dataOf(const QString& unit) const;
  void showValues();
  void setCursor_s(double time_s);

  LiveWorld& world_;
  SignalRecord record_;
  std::vector<PlotMarker> marks_;
  SignalPicker* picker_;
  QSplitter* plotRow_;
  QLabel* empty_;
  QMap<QString, PlotWidget*> plots_;
  QTableWidget* values_;
  QToolButton* pause_;
  QDoubleSpinBox *span_, *cursor_;
  QTimer redraw_;
  bool stale_ = false, wasPlaying_ = false;
  bool another_ = true;  ///< no signals of the opened world were taken yet
};

}  // namespace btr::ui
