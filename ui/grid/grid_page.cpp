#include "ui/grid/grid_page.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <algorithm>
#include <cmath>

#include "core/run/grid/grid_cells.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/decimal_spin_box.h"
#include "ui/common/numbers/format.h"
#include "ui/grid/cube_view.h"
#include "ui/grid/kick_map.h"

namespace btr::ui {
namespace {

QDoubleSpinBox* numberBox(const QString& name, const QString& unit, int decimals, double step, const QString& tip) {
  auto* box = new DecimalSpinBox;
  box->setDecimals(decimals);
  box->setSingleStep(step);
  box->setSuffix(unit);
  box->setAccessibleName(name);
  box->setToolTip(tip);
  return box;
}

}  // namespace

GridPage::GridPage(const QString& program, QWidget* parent)
    : QWidget(parent), process_(program), cube_(new CubeView(this)), map_(new KickMap(this)) {
  auto* right = new QWidget(this);
  auto* rightLayout = new QVBoxLayout(right);
  rightLayout->setContentsMargins(0, 0, 0, 0);
  rightLayout->addWidget(makePreview());
  rightLayout->addWidget(map_, 1);
  rightLayout->addWidget(makeMapBar());
  auto* split = new QSplitter(this);
  split->addWidget(cube_);
  split->addWidget(right);
  split->setStretchFactor(0, 5);
  split->setStretchFactor(1, 4);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(makeTop());
  layout->addWidget(split, 1);

  connect(cube_, &CubeView::chosen, this, [this](int cell) {
    if (const GridSummary* s = summary())
      for (const GridRow& row : s->rows)
        if (row.cell == cell) setPoint(row.task);
    cell_->setText(cube_->describe(cell).replace('\n', QStringLiteral("; ")));
    replay_->setEnabled(true);
  });
  connect(cube_, &CubeView::replayRequested, this, &GridPage::replayCell);
  connect(map_, &KickMap::chosen, this, [this](double bearing, double direction) {
    setPoint({point()[0], bearing, direction});
    play();
  });
  connect(&process_, &ProgramProcess::progressed, this,
          [this](const QString&, double share) { progress_->setValue(static_cast<int>(std::lround(1000 * share))); });
  const auto ended = [this] {
    progress_->hide();
    compute_->setText(tr("Compute map"));
  };
  connect(&process_, &ProgramProcess::cancelled, this, ended);
  connect(&process_, &ProgramProcess::failed, this, [this, ended](const QString& message) {
    ended();
    emit failed(message);
  });
  connect(&process_, &ProgramProcess::done, this, [this, ended](const QByteArray& output) {
    ended();
    try {
      maps_[computing_] = gridMapFromJson(output.toStdString(), "map");
    } catch (const std::exception& error) {
      return emit failed(QString::fromUtf8(error.what()));
    }
    showPoint();
    emit mapDone();
  });
  showGrid();
}

QWidget* GridPage::makeTop() {
  auto* bar = new QWidget(this);
  auto* column = new QVBoxLayout(bar);
  column->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout;
  grid_ = new QComboBox(bar);
  grid_->setAccessibleName(tr("Grid"));
  grid_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  slice_ = new QComboBox(bar);
  slice_->setAccessibleName(tr("Distances shown"));
  replay_ = new QPushButton(themeIcon("media-playback-playing"), tr("Replay cell"), bar);
  replay_->setToolTip(tr("Replays the solution of the chosen cell in 3D (double click, or Enter)"));
  for (QWidget* widget : {static_cast<QWidget*>(grid_), static_cast<QWidget*>(slice_), static_cast<QWidget*>(replay_)})
    row->addWidget(widget);
  row->addStretch(1);
  learned_ = new QProgressBar(bar);
  learned_->setObjectName("learned");
  learned_->setMinimumWidth(200);
  go_ = new QPushButton(bar);
  go_->setObjectName("go");
  new_ = new QPushButton(themeIcon("document-new"), tr("New grid…"), bar);
  new_->setObjectName("new");
  new_->setToolTip(tr("Describes a grid of experiments and starts it"));
  for (QWidget* widget : {static_cast<QWidget*>(learned_), static_cast<QWidget*>(go_), static_cast<QWidget*>(new_)})
    row->addWidget(widget);
  connect(new_, &QPushButton::clicked, this, &GridPage::newRequested);
  connect(go_, &QPushButton::clicked, this,
          [this] { states_[current()].isActive ? emit stopRequested(current()) : emit continueRequested(current()); });
  summary_ = new QLabel(bar);
  cell_ = new QLabel(bar);
  for (QLabel* label : {summary_, cell_}) label->setWordWrap(true);
  column->addLayout(row);
  column->addWidget(summary_);
  column->addWidget(cell_);
  connect(grid_, &QComboBox::currentIndexChanged, this, [this] { showGrid(); });
  connect(slice_, &QComboBox::currentIndexChanged, this, [this](int index) { cube_->setSlice(index - 1); });
  connect(replay_, &QPushButton::clicked, this, [this] { replayCell(cube_->current()); });
  return bar;
}

QWidget* GridPage::makePreview() {
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  distance_ = numberBox(tr("Distance of the ball"), tr(" m"), 3, 0.005, tr("d: from the neck to the ball"));
  bearing_ =
      numberBox(tr("Bearing of the ball"), tr("°"), 2, 2.5, tr("β: where the ball lies, 0 ahead, positive left"));
  direction_ =
      numberBox(tr("Direction of the kick"), tr("°"), 2, 2.5, tr("α: where it should go, 0 ahead, positive left"));
  play_ = new QPushButton(themeIcon("media-playback-start"), tr("Play this kick"), bar);
  play_->setToolTip(tr("Simulates the interpolated kick and shows it in 3D"));
  for (const auto& [label, box] : {std::pair(tr("d"), distance_), {tr("β"), bearing_}, {tr("α"), direction_}}) {
    row->addWidget(new QLabel(label, bar));
    row->addWidget(box);
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] { showPoint(); });
  }
  row->addWidget(play_);
  row->addStretch(1);
  connect(play_, &QPushButton::clicked, this, &GridPage::play);
  return bar;
}

QWidget* GridPage::makeMapBar() {
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  shown_ = new QComboBox(bar);
  shown_->setAccessibleName(tr("What the map shows"));
  shown_->addItem(tr("what is lost"), QString());
  shown_->addItem(tr("fitness"), QStringLiteral("fitness"));
  steps_ = new QSpinBox(bar);
  steps_->setRange(3, 101);
  steps_->setValue(21);
  steps_->setSuffix(tr(" steps"));
  steps_->setToolTip(tr("Along each angle; the time grows with its square"));
  compute_ = new QPushButton(tr("Compute map"), bar);
  compute_->setToolTip(tr("Tries interpolated kicks at this distance, beside the window"));
  progress_ = new QProgressBar(bar);
  progress_->setRange(0, 1000);
  progress_->hide();
  for (QWidget* widget :
       {static_cast<QWidget*>(shown_), static_cast<QWidget*>(steps_), static_cast<QWidget*>(compute_)})
    row->addWidget(widget);
  row->addWidget(progress_, 1);
  row->addStretch(0);
  connect(shown_, &QComboBox::currentIndexChanged, this, [this] { map_->setShown(shown_->currentData().toString()); });
  connect(compute_, &QPushButton::clicked, this, [this] { isComputing() ? cancelMap() : computeMap(); });
  return bar;
}

const GridSummary* GridPage::summary() const {
  const auto found = std::ranges::find(grids_, current(), [](const GridSummary& s) { return s.grid.id; });
  return found == grids_.end() ? nullptr : &*found;
}

Id GridPage::current() const { return grid_->currentData().toLongLong(); }

void GridPage::choose(Id grid) {
  if (const int index = grid_->findData(QVariant::fromValue(static_cast<qlonglong>(grid))); index >= 0)
    grid_->setCurrentIndex(index);
}

QString GridPage::nameOf(const GridRecord& grid) {
  return tr("%1: %2, seed %3")
      .arg(QString::fromStdString(grid.name), QString::fromStdString(grid.method))
      .arg(grid.seed);
}

void GridPage::setGrids(const QString& database, const std::vector<GridSummary>& grids) {
  const Id before = current();
  if (database != database_) {
    // A map on its way is of a grid that may be another one there.
    cancelMap();
    maps_.clear();
  }
  database_ = database;
  grids_ = grids;
  {
    const QSignalBlocker quiet(grid_);
    grid_->clear();
    for (const GridSummary& s : grids_) grid_->addItem(nameOf(s.grid), static_cast<qlonglong>(s.grid.id));
    const int index = grid_->findData(static_cast<qlonglong>(before));
    grid_->setCurrentIndex(std::max(index, grids_.empty() ? -1 : 0));
  }
  showGrid();
}

void GridPage::setStates(const std::map<Id, GridState>& states) {
  states_ = states;
  showState();
}

void GridPage::showState() {
  const auto found = states_.find(current());
  const bool isOpen = found != states_.end() && !found->second.isFinished;
  go_->setVisible(isOpen);
  learned_->setVisible(isOpen);
  if (!isOpen) return;
  const GridState& state = found->second;
  go_->setText(state.isActive ? tr("Stop") : tr("Continue"));
  go_->setIcon(themeIcon(state.isActive ? "media-playback-stop" : "media-playback-start"));
  go_->setToolTip(state.isActive ? tr("What it has learned is kept; it goes on with the same bits")
                                 : tr("Goes on with the same bits where it stopped"));
  learned_->setFormat(state.done >= state.total ? tr("settling the cells")
                                                : tr("generation %1 of %2").arg(state.done).arg(state.total));
  learned_->setRange(0, std::max(1, state.total));
  learned_->setValue(state.done);
}

void GridPage::showGrid() {
  showState();
  const GridSummary* s = summary();
  const bool settled = s && static_cast<int>(s->rows.size()) == static_cast<int>(cellsOf(s->spec).size());
  for (QWidget* widget :
       {static_cast<QWidget*>(distance_), static_cast<QWidget*>(bearing_), static_cast<QWidget*>(direction_),
        static_cast<QWidget*>(play_), static_cast<QWidget*>(compute_), static_cast<QWidget*>(steps_)})
    widget->setEnabled(settled);
  cube_->setSummary(s ? *s : GridSummary{});
  replay_->setEnabled(cube_->current() != 0);
  cell_->setText(cube_->current() ? cube_->describe(cube_->current()).replace('\n', QStringLiteral("; "))
                                  : tr("Click a cell to choose it, double click to replay its kick."));
  const QSignalBlocker quietSlice(slice_);
  slice_->clear();
  slice_->addItem(tr("all distances"));
  if (!s) {
    summary_->setText(tr("No grid in this database yet: “New grid…” describes one and learns it."));
    map_->setMap({});
    return;
  }
  for (const double d : s->spec.axes[0]) slice_->addItem(tr("d %1 m").arg(d));
  slice_->setCurrentIndex(cube_->slice() + 1);
  const QString unit = QString::fromStdString(s->unit);
  QString text = tr("%1 cells, %2 of them learned; mean fitness %3; %4 failed, %5 replaced; similarity along the edges "
                    "%6")
                     .arg(cellsOf(s->spec).size())
                     .arg(s->learning)
                     .arg(withUnit(s->cellMean, unit))
                     .arg(s->failed)
                     .arg(s->taken)
                     .arg(shortNumber(s->edgeMean));
  if (!settled)
    text = tr("%1 of %2 cells are not settled yet")
               .arg(cellsOf(s->spec).size() - s->rows.size())
               .arg(cellsOf(s->spec).size());
  if (s->points) text += tr("; between the cells %1 (%2 kicks)").arg(withUnit(s->pointMean, unit)).arg(s->points);
  summary_->setText(text);
  const std::array boxes{distance_, bearing_, direction_};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const QSignalBlocker quiet(boxes[axis]);
    const double scale = axis ? inDegrees : 1;
    const double before = boxes[axis]->value();
    boxes[axis]->setRange(s->spec.axes[axis].front() * scale, s->spec.axes[axis].back() * scale);
    boxes[axis]->setValue(before);
  }
  map_->setAxes(s->spec.axes[1], s->spec.axes[2]);
  showPoint();
}

/// The boxes show rounded numbers: at the ends of the grid the point stays inside.
std::array<double, 3> GridPage::point() const {
  std::array<double, 3> point{distance_->value(), bearing_->value() / inDegrees, direction_->value() / inDegrees};
  if (const GridSummary* s = summary())
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = std::clamp(point[axis], s->spec.axes[axis].front(), s->spec.axes[axis].back());
  return point;
}

void GridPage::setPoint(const std::array<double, 3>& point) {
  const std::array boxes{distance_, bearing_, direction_};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const QSignalBlocker quiet(boxes[axis]);
    boxes[axis]->setValue(point[axis] * (axis ? inDegrees : 1));
  }
  showPoint();
}

/// The map of the chosen distance, if one was computed.
void GridPage::showPoint() {
  const auto at = point();
  map_->setPoint(at[1], at[2]);
  const auto known = maps_.find({current(), at[0]});
  const QString before = shown_->currentData().toString();
  map_->setMap(known == maps_.end() ? std::nullopt : std::optional(known->second));
  if (!map_->map()) return;
  const QSignalBlocker quiet(shown_);
  while (shown_->count() > 2) shown_->removeItem(2);
  for (const QString& name : map_->figures()) shown_->addItem(name, name);
  shown_->setCurrentIndex(std::max(0, shown_->findData(before)));
  map_->setShown(shown_->currentData().toString());
}

void GridPage::computeMap() {
  if (!summary() || isComputing()) return;
  computing_ = {current(), point()[0]};
  progress_->setValue(0);
  progress_->show();
  compute_->setText(tr("Cancel"));
  const QString steps = QString::number(steps_->value());
  process_.start({"--json", "grid", "map", "--db", database_, "--grid", QString::number(computing_.first),
                  "--distance-m", QString::number(computing_.second, 'g', 17), "--columns", steps, "--rows", steps,
                  "--progress"});
}

void GridPage::replayCell(int cell) {
  if (const GridSummary* s = summary())
    for (const GridRow& row : s->rows)
      if (row.cell == cell) emit replayRequested(row.run, row.individual);
}

void GridPage::play() {
  const auto at = point();
  if (summary() && play_->isEnabled()) emit kickRequested(current(), at[0], at[1], at[2]);
}

}  // namespace btr::ui
