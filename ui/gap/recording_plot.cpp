#include "ui/gap/recording_plot.h"

#include <QComboBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/residual.h"
#include "core/spec/error.h"
#include "ui/charts/broken_curve.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {

std::vector<QPointF> curveOfChannel(const Recording& trial, int channel) {
  std::vector<QPointF> points;
  const std::vector<double>& time = trial.columns[0];
  const std::vector<double>& value = trial.columns[static_cast<std::size_t>(channel)];
  for (std::size_t row = 0; row < trial.rows(); ++row)
    if (std::isfinite(value[row])) points.emplace_back(time[row], value[row]);
  return points;
}

}  // namespace

RecordingPlot::RecordingPlot(QWidget* parent)
    : QWidget(parent), channel_(new QComboBox(this)), plot_(new PlotWidget(this)) {
  setObjectName("recordingPlot");
  channel_->setAccessibleName(tr("Channel of the recording"));
  channel_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  channel_->setMinimumContentsLength(30);
  auto* bar = new QHBoxLayout;
  bar->addWidget(new QLabel(tr("Channel"), this));
  bar->addWidget(channel_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 4, 8, 0);
  layout->addLayout(bar);
  layout->addWidget(plot_, 1);
  connect(channel_, &QComboBox::currentIndexChanged, this, &RecordingPlot::draw);
}

void RecordingPlot::setRecording(const QString& path, const QString& mapping, const QString& scene) {
  const QString before = channel_->currentText();
  trials_.clear();
  QString trouble;
  try {
    if (!path.isEmpty()) trials_ = loadTrialsFor(path.toStdString(), mapping.toStdString(), scene.toStdString());
  } catch (const InputError& error) {
    trouble = QString::fromUtf8(error.what());
  }
  {
    const QSignalBlocker quiet(channel_);
    channel_->clear();
    if (!trials_.empty())
      for (std::size_t k = 1; k < trials_.front().channels.size(); ++k)
        channel_->addItem(word(trials_.front().channels[k]));
    // The first measurement says most; commands stand beside it.
    int first = channel_->findText(before);
    for (int k = 0; first < 0 && k < channel_->count(); ++k)
      if (!channel_->itemText(k).contains(".command_") && parseChannel(channel_->itemText(k).toStdString())) first = k;
    if (channel_->count() > 0) channel_->setCurrentIndex(std::max(0, first));
  }
  draw();
  if (!trouble.isEmpty()) {
    PlotData empty;
    empty.empty = trouble;
    plot_->setData(empty);
  }
}

void RecordingPlot::draw() {
  PlotData plot;
  plot.xTitle = tr("time (s)");
  plot.xColumn = "time_s";
  plot.empty = tr("Choose a recording above");
  const std::string channel = channel_->currentText().toStdString();
  const std::string unit = unitOfChannel(channel);
  plot.yTitle = axisTitle(word(channel), word(unit));
  plot.yColumn = word(channel);
  // The command of the same joint, where it is in the same unit.
  const std::size_t dot = channel.rfind('.');
  const std::size_t under = channel.find("position_", dot == std::string::npos ? 0 : dot);
  const std::string command =
      under == std::string::npos ? "" : channel.substr(0, under) + "command_" + channel.substr(under + 9);
  int colour = 0;
  for (const Recording& trial : trials_) {
    if (const int column = trial.column(channel); column > 0)
      addBroken(plot, {QFileInfo(word(trial.source)).fileName(),
                       colour,
                       PlotSeries::Style::line,
                       curveOfChannel(trial, column),
                       {},
                       false});
    if (const int column = command.empty() ? -1 : trial.column(command); column > 0)
      addBroken(plot, {tr("%1, command").arg(QFileInfo(word(trial.source)).fileName()),
                       colour + 1,
                       PlotSeries::Style::thinLine,
                       curveOfChannel(trial, column),
                       {},
                       false});
    colour += 2;
  }
  plot_->setData(std::move(plot));
}

}  // namespace btr::ui
