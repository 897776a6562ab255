#include "ui/live/panels/signals_panel.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMouseEvent>
#include <QScrollArea>
#include <QSplitter>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <map>
#include <utility>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "ui/charts/decimate.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/decimal_spin_box.h"
#include "ui/common/numbers/format.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/signal_picker.h"

namespace btr::ui {
namespace {

constexpr int redrawEvery_ms = 100;

/// Without its unit, which stands at the axis.
QString shortName(const std::string& name) {
  static const std::map<std::string, QString> endings{{"rad", "_rad"},   {"rad/s", "_rad_s"},  {"N·m", "_nm"},
                                                      {"m", "_m"},       {"m/s", "_m_s"},      {"N", "_n"},
                                                      {"m/s²", "_m_s2"}, {"rad/s²", "_rad_s2"}};
  const auto ending = endings.find(unitOfSignal(name));
  QString text = word(name);
  if (ending != endings.end()) text.chop(ending->second.size());
  return text;
}

QToolButton* button(const QString& name, const QString& icon, const QString& text, const QString& tip,
                    QWidget* parent) {
  auto* made = new QToolButton(parent);
  made->setObjectName(name);
  made->setIcon(themeIcon(icon));
  made->setText(text);
  made->setToolTip(tip);
  made->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  made->setAutoRaise(true);
  made->setFocusPolicy(Qt::StrongFocus);
  return made;
}

}  // namespace

SignalsPanel::SignalsPanel(LiveWorld& world, QWidget* parent)
    : QWidget(parent), world_(world), picker_(new SignalPicker(this)), plotRow_(new QSplitter(this)) {
  setObjectName("liveSignalsPanel");
  values_ = new QTableWidget(0, 3, this);
  values_->setObjectName("liveSignalValues");
  values_->setAccessibleName(tr("Values of the signals"));
  values_->setHorizontalHeaderLabels({tr("Signal"), tr("Value"), tr("Unit")});
  values_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  values_->setTabKeyNavigation(false);
  values_->verticalHeader()->hide();
  values_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  values_->horizontalHeader()->resizeSection(1, 70);
  values_->horizontalHeader()->resizeSection(2, 50);
  values_->verticalHeader()->setDefaultSectionSize(22);
  empty_ = new QLabel(tr("Choose signals on the left."), this);
  empty_->setAlignment(Qt::AlignCenter);
  plotRow_->addWidget(empty_);
  // Many plots scroll: they do not make the window wider.
  auto* plots = new QScrollArea(this);
  plots->setWidgetResizable(true);
  plots->setFrameShape(QFrame::NoFrame);
  plots->setWidget(plotRow_);
  // On a small screen the plots are what keeps its room.
  plots->setMinimumWidth(220);
  picker_->setMinimumWidth(120);
  values_->setMinimumWidth(150);
  auto* split = new QSplitter(this);
  split->addWidget(picker_);
  split->addWidget(plots);
  split->addWidget(values_);
  split->setStretchFactor(1, 1);
  split->setSizes({200, 600, 250});
  split->setChildrenCollapsible(false);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->setSpacing(2);
  column->addWidget(makeBar());
  column->addWidget(split, 1);
  connect(picker_, &SignalPicker::chosenChanged, this, &SignalsPanel::choose);
  connect(picker_, &SignalPicker::tooMany, this,
          [this] { emit problem(tr("%1 signals at once are the most.").arg(SignalPicker::most)); });
  connect(&world_, &LiveWorld::objectsChanged, this,
          [this] { picker_->setSignals(signalsOf(world_.channels()), !std::exchange(another_, false)); });
  connect(&world_, &LiveWorld::forgotten, this, [this] {
    another_ = true;
    clear();
  });
  connect(&world_.process(), &LiveProcess::sampled, this, &SignalsPanel::take);
  connect(&world_, &LiveWorld::rowChanged, this, [this] {
    stale_ = stale_ || world_.row().playing != wasPlaying_;
    wasPlaying_ = world_.row().playing;
  });
  redraw_.setInterval(redrawEvery_ms);
  connect(&redraw_, &QTimer::timeout, this, [this] {
    if (stale_ && isVisible() && !pause_->isChecked()) draw();
  });
  redraw_.start();
}

QWidget* SignalsPanel::makeBar() {
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  pause_ = button("liveSignalsPause", "media-playback-pause", tr("Hold"),
                  tr("Stops the plots, to be looked at; nothing that happens meanwhile is lost"), bar);
  pause_->setCheckable(true);
  connect(pause_, &QToolButton::toggled, this, [this] { draw(); });
  auto* clearAll = button("liveSignalsClear", "edit-clear", tr("Clear"), tr("Forgets what was recorded"), bar);
  connect(clearAll, &QToolButton::clicked, this, &SignalsPanel::clear);
  auto* save = button("liveSignalsExport", "document-export", tr("Export…"),
                      tr("A recording (CSV): every control period that is kept, as gap analysis reads it"), bar);
  connect(save, &QToolButton::clicked, this, &SignalsPanel::exportWithDialog);
  const auto number = [&](const QString& name, const QString& text, const QString& tip, double from, double to) {
    auto* label = new QLabel(text, bar);
    auto* box = new DecimalSpinBox(bar);
    box->setObjectName(name);
    box->setAccessibleName(text);
    box->setToolTip(tip);
    box->setRange(from, to);
    box->setSuffix(" s");
    label->setBuddy(box);
    row->addWidget(label);
    row->addWidget(box);
    return box;
  };
  row->addWidget(pause_);
  row->addWidget(clearAll);
  row->addWidget(save);
  row->addStretch();
  span_ = number("liveSignalsSpan", tr("Keeps the last"), tr("What is older is forgotten"), 1, 3600);
  span_->setDecimals(0);
  span_->setValue(record_.span_s());
  connect(span_, &QDoubleSpinBox::valueChanged, this, [this](double value) { record_.setSpan_s(value); });
  cursor_ = number("liveSignalsCursor", tr("Values at"), tr("Follows the mouse over a plot"), -1, 1e6);
  cursor_->setDecimals(3);
  cursor_->setSingleStep(0.008);
  cursor_->setSpecialValueText(tr("newest"));
  cursor_->setValue(-1);
  cursor_->setFixedWidth(110);
  connect(cursor_, &QDoubleSpinBox::valueChanged, this, &SignalsPanel::showValues);
  return bar;
}

void SignalsPanel::choose() {
  record_.setSignals(picker_->chosen());
  world_.process().setSignals(record_.channels());
  cursor_->setSingleStep(world_.game().scene.controlPeriod_s);
  QStringList units;
  for (const Signal& signal : record_.all())
    if (const QString unit = word(unitOfSignal(signal.name)); !units.contains(unit)) units << unit;
  for (const QString& gone : plots_.keys())
    if (!units.contains(gone)) delete plots_.take(gone);
  for (const QString& unit : units) {
    if (plots_.contains(unit)) continue;
    auto* plot = new PlotWidget(plotRow_);
    plot->setAccessibleName(unit.isEmpty() ? tr("Signals without a unit") : tr("Signals in %1").arg(unit));
    if (auto* area = plot->findChild<QWidget*>("plotArea")) area->installEventFilter(this);
    plotRow_->addWidget(plot);
    plots_[unit] = plot;
  }
  empty_->setVisible(plots_.isEmpty());
  values_->setRowCount(int(record_.all().size()));
  for (int i = 0; i < values_->rowCount(); ++i) {
    const std::string& name = record_.all()[std::size_t(i)].name;
    values_->setItem(i, 0, new QTableWidgetItem(word(name)));
    values_->setItem(i, 1, new QTableWidgetItem);
    values_->item(i, 1)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    values_->setItem(i, 2, new QTableWidgetItem(word(unitOfSignal(name))));
    values_->item(i, 0)->setToolTip(word(name));
  }
  draw();
}

void SignalsPanel::take(const LiveSamples& samples) {
  const std::size_t width = samples.channels.size();
  for (std::size_t i = 0; i < samples.periods.size(); ++i)
    record_.add(samples.periods[i], samples.channels, std::span(samples.values).subspan(i * width, width));
  stale_ = true;
}

void SignalsPanel::clear() {
  record_.clear();
  marks_.clear();
  draw();
}

void SignalsPanel::mark(const QString& label) {
  if (world_.row().values.empty()) return;
  marks_.push_back({world_.scene().time_s(world_.row()), label});
  stale_ = true;
}

// While it goes on no more than a screen shows; what is looked at closely has every control period.
PlotData SignalsPanel::dataOf(const QString& unit) const {
  const bool thinned = world_.row().playing && !pause_->isChecked() && !plots_[unit]->isZoomed();
  PlotData data;
  data.xTitle = tr("time (s)");
  data.xColumn = "time_s";
  data.yTitle = unit.isEmpty() ? tr("no unit") : unit;
  data.empty = tr("Nothing yet: the world waits");
  const std::size_t rows = record_.rows();
  int colour = 0;
  for (std::size_t i = 0; i < record_.all().size(); ++i) {
    const std::string& name = record_.all()[i].name;
    if (word(unitOfSignal(name)) != unit) continue;
    // No line leads over a time in which what it belongs to was gone.
    PlotSeries series;
    series.name = shortName(name);
    series.colour = colour++;
    const auto endPiece = [&] {
      if (thinned && rows > 0)
        series.points = decimate(series.points, record_.time_s(0), record_.time_s(rows - 1), plots_[unit]->width());
      data.series.push_back(series);
      series.points.clear();
      series.name.clear();  // it stands once in the legend
    };
    for (std::size_t row = 0; row < rows; ++row)
      if (const double value = record_.value(row, i); std::isfinite(value))
        series.points.emplace_back(record_.time_s(row), value);
      else if (!series.points.empty())
        endPiece();
    if (!series.points.empty() || !series.name.isEmpty()) endPiece();
  }
  for (const PlotMarker& mark : marks_)
    if (rows > 0 && mark.x >= record_.time_s(0)) data.markers.push_back(mark);
  return data;
}

void SignalsPanel::draw() {
  stale_ = false;
  for (auto plot = plots_.begin(); plot != plots_.end(); ++plot) plot.value()->setData(dataOf(plot.key()));
  showValues();
}

void SignalsPanel::showValues() {
  const bool newest = cursor_->value() < 0;
  for (int i = 0; i < values_->rowCount(); ++i) {
    if (record_.rows() == 0) {
      values_->item(i, 1)->setText({});
      continue;
    }
    const std::size_t row = newest ? record_.rows() - 1 : record_.rowAt(cursor_->value());
    values_->item(i, 1)->setText(shortNumber(record_.value(row, std::size_t(i))));
  }
}

void SignalsPanel::setCursor_s(double time_s) { cursor_->setValue(time_s); }

// The values under the mouse; once it is away the newest ones again, while the plots go on.
bool SignalsPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseMove) {
    const auto* area = static_cast<QWidget*>(watched);
    for (const PlotWidget* plot : std::as_const(plots_)) {
      if (!plot->isAncestorOf(area) || record_.rows() == 0) continue;
      const QRectF range = plot->visibleRange();
      const double left = plot->placeOf(range.topLeft()).x(), right = plot->placeOf(range.topRight()).x();
      const double at = area->mapTo(plot, static_cast<QMouseEvent*>(event)->pos()).x();
      if (right > left) setCursor_s(std::max(0.0, range.left() + (at - left) / (right - left) * range.width()));
    }
  }
  if (event->type() == QEvent::Leave && !pause_->isChecked()) setCursor_s(-1);
  return QWidget::eventFilter(watched, event);
}

void SignalsPanel::exportTo(const QString& path) const {
  if (record_.rows() == 0)
    throw InputError(path.toStdString(), "nothing was recorded", "signals of a world that has run");
  writeFile(path.toStdString(), record_.toCsv());
}

void SignalsPanel::exportWithDialog() {
  QString file = QFileDialog::getSaveFileName(this, tr("Export signals"), "signals.csv", tr("Recordings (*.csv)"));
  if (file.isEmpty()) return;
  if (!file.endsWith(".csv")) file += ".csv";
  try {
    exportTo(file);
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

}  // namespace btr::ui
