#pragma once
#include <QWidget>
#include <vector>

#include "core/gap/recordings/recording.h"

class QComboBox;

namespace btr::ui {
class PlotWidget;

/// A recording as its mapping reads it, one channel at a time, before anything is analysed: a wrong unit, sign or
/// column is seen here. A command is drawn beside the position that follows it.
class RecordingPlot : public QWidget {
  Q_OBJECT
 public:
  explicit RecordingPlot(QWidget* parent = nullptr);
  /// Reads the file's trials; what cannot be read is said in the plot.
  void setRecording(const QString& path, const QString& mapping, const QString& scene);
  PlotWidget& plot() { return *plot_; }
  QComboBox& channel() { return *channel_; }

 private:
  void draw();

  std::vector<Recording> trials_;
  QComboBox* channel_;
  PlotWidget* plot_;
};

}  // namespace btr::ui
