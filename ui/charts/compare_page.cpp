#include "ui/charts/compare_page.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QResizeEvent>
#include <QSplitter>
#include <QTabWidget>
#include <QTableWidget>
#include <QTimer>
#include <QTreeWidget>
#include <algorithm>

#include "ui/charts/plot_widget.h"
#include "ui/charts/stage_plot.h"
#include "ui/common/database/reading_table.h"
#include "ui/common/look/plain_tip.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {
constexpr int runRole = Qt::UserRole;
constexpr int listWidth = 340, chartsWidth = 860;    ///< of the room that they share side by side
constexpr int leastBeside = 2 * listWidth;           ///< narrower, the list stands above
constexpr int listHeight = 170, chartsHeight = 430;  ///< of the room that they share one above the other

/// The same experiment with the same seed: the same bits once more, no further draw.
bool isSameRun(const RunRecord& a, const RunRecord& b) {
  return a.seed == b.seed && a.specSha256 == b.specSha256 && withoutSeed(a) == withoutSeed(b);
}

/// Runs that differ only in their seed as one arm, in the order in which the first of each comes; by seed.
std::vector<ComparedArm> armsOf(const std::vector<FitnessRun>& curves, const std::vector<RunRecord>& records,
                                const std::map<Id, ComparePage::History>& read, bool joinSeeds) {
  struct Member {
    std::uint64_t seed;
    const std::vector<StageOutcome>* stages;
  };
  std::vector<QString> groups;
  std::vector<std::vector<Member>> members;
  std::vector<ComparedArm> arms;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const QString group = joinSeeds ? curves[i].group : QString::number(curves[i].run);
    const auto known = std::find(groups.begin(), groups.end(), group);
    const auto index = static_cast<std::size_t>(known - groups.begin());
    if (known == groups.end()) {
      groups.push_back(group);
      members.emplace_back();
      arms.push_back({(joinSeeds ? curves[i].experiment : curves[i].name).toStdString(), {}, {}});
    }
    members[index].push_back({records[i].seed, &read.at(curves[i].run).stages});
  }
  for (std::size_t a = 0; a < arms.size(); ++a) {
    std::stable_sort(members[a].begin(), members[a].end(), [](auto& x, auto& y) { return x.seed < y.seed; });
    for (const Member& member : members[a]) arms[a].runs.push_back(*member.stages);
  }
  compareArms(arms);
  return arms;
}

}  // namespace

ComparePage::ComparePage(QWidget* parent)
    : QWidget(parent),
      parts_(new QSplitter(this)),
      tree_(new QTreeWidget(this)),
      plot_(new PlotWidget(this)),
      stages_(new PlotWidget(this)),
      real_(new PlotWidget(this)),
      charts_(new QTabWidget(this)),
      differences_(new QTableWidget(this)),
      reached_(new QTableWidget(this)) {
  tree_->setHeaderLabels({tr("run"), tr("seed"), tr("generations")});
  tree_->setAccessibleName(tr("Runs to compare"));
  tree_->setToolTip(tr("Tick the runs to compare; a tick beside an experiment takes all of its runs"));
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  // A tick beside an experiment changes all of its runs, one after another: they are drawn together.
  ticked_ = new QTimer(this);
  ticked_->setSingleShot(true);
  connect(ticked_, &QTimer::timeout, this, [this] {
    draw();
    ask();
  });
  connect(tree_, &QTreeWidget::itemChanged, ticked_, qOverload<>(&QTimer::start));

  differences_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  differences_->setAlternatingRowColors(true);
  differences_->verticalHeader()->hide();
  differences_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 7);
  differences_->setAccessibleName(tr("Settings of the chosen runs"));
  summary_ = new QLabel(this);
  leftOut_ = new QLabel(this);
  leftOut_->setObjectName("leftOut");
  leftOut_->setWordWrap(true);
  leftOut_->setTextFormat(Qt::PlainText);  // names are people's

  auto* below = new QWidget(this);
  auto* belowLayout = new QVBoxLayout(below);
  belowLayout->setContentsMargins(0, 0, 0, 0);
  belowLayout->addWidget(leftOut_);
  belowLayout->addWidget(makeOptions());
  belowLayout->addWidget(differences_, 1);
  auto* right = new QSplitter(Qt::Vertical, this);
  charts_->addTab(plot_, tr("Fitness by generation"));
  charts_->addTab(stages_, tr("Gap by stage"));
  charts_->addTab(real_, tr("Real fitness by stage"));
  charts_->addTab(reached_, tr("At the end"));
  reached_->setAccessibleName(tr("What was reached after the last common stage"));
  reached_->setObjectName("reached");
  right->addWidget(charts_);
  right->addWidget(below);
  right->setStretchFactor(0, 3);
  right->setStretchFactor(1, 2);
  parts_->addWidget(tree_);
  parts_->addWidget(right);
  parts_->setStretchFactor(0, 1);
  parts_->setStretchFactor(1, 3);
  arrange(Qt::Horizontal);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(parts_);
  draw();
}

void ComparePage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const auto wanted = width() < leastBeside ? Qt::Vertical : Qt::Horizontal;
  if (parts_->orientation() != wanted) arrange(wanted);
}

void ComparePage::arrange(Qt::Orientation orientation) {
  const bool isBeside = orientation == Qt::Horizontal;
  parts_->setOrientation(orientation);
  tree_->setMinimumWidth(isBeside ? listWidth : 0);
  parts_->setSizes(isBeside ? QList{listWidth, chartsWidth} : QList{listHeight, chartsHeight});
}

QWidget* ComparePage::makeOptions() {
  auto* bar = new QWidget(this);
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(0, 0, 0, 0);
  joinSeeds_ = new QCheckBox(tr("Join seeds"), bar);
  joinSeeds_->setChecked(true);
  joinSeeds_->setToolTip(tr("Runs that differ only in their seed as one curve: mean and 95 % interval of the maximum"));
  onlyDifferent_ = new QCheckBox(tr("Only what differs"), bar);
  onlyDifferent_->setChecked(true);
  for (QCheckBox* box : {joinSeeds_, onlyDifferent_}) connect(box, &QCheckBox::toggled, this, &ComparePage::draw);
  layout->addWidget(joinSeeds_);
  layout->addWidget(onlyDifferent_);
  layout->addStretch(1);
  layout->addWidget(summary_);
  return bar;
}

void ComparePage::setRuns(const std::vector<RunRecord>& runs, const std::map<Id, QString>& experiments) {
  std::map<Id, const RunRecord*> before;
  for (const RunRecord& run : runs_) before[run.id] = &run;
  for (const RunRecord& run : runs)
    if (const auto known = before.find(run.id);
        known == before.end() || known->second->generation != run.generation || known->second->stage != run.stage ||
        known->second->state != run.state || known->second->updatedAt != run.updatedAt)
      fresh_.erase(run.id);
  runs_ = runs;
  experiments_ = experiments;
  QStringList list;
  for (const RunRecord& run : runs_)
    list << QString::number(run.id) << experimentOf(run) << QString::number(run.seed)
         << QString::fromStdString(run.reality) << QString::fromStdString(run.note);
  if (list == listed_) return showGenerations();
  const std::vector<Id> ticked = chosen();
  listed_ = list;
  listRuns();
  setChosen(ticked);
}

// While runs learn, four times a second.
void ComparePage::showGenerations() {
  std::map<Id, int> generations;
  for (const RunRecord& run : runs_) generations[run.id] = run.generation;
  const QSignalBlocker quiet(tree_);
  for (QTreeWidgetItemIterator item(tree_, QTreeWidgetItemIterator::NoChildren); *item; ++item) {
    const QString text = QString::number(generations[(*item)->data(0, runRole).toLongLong()]);
    if ((*item)->text(2) != text) (*item)->setText(2, text);
  }
}

void ComparePage::listRuns() {
  const QSignalBlocker quiet(tree_);
  tree_->clear();
  std::map<Id, QTreeWidgetItem*> parents;
  for (const RunRecord& run : runs_) {
    QTreeWidgetItem*& parent = parents[run.experiment];
    if (!parent) {
      parent = new QTreeWidgetItem(tree_, {experimentOf(run)});
      parent->setFlags(parent->flags() | Qt::ItemIsUserCheckable | Qt::ItemIsAutoTristate);
      parent->setExpanded(true);
      parent->setFirstColumnSpanned(true);
    }
    QString text = tr("Run %1").arg(run.id);
    if (run.reality == "stand_in") text += tr(" (stand-in)");
    auto* item = new QTreeWidgetItem(parent, {text, QString::number(run.seed), QString::number(run.generation)});
    item->setData(0, runRole, static_cast<qlonglong>(run.id));
    item->setCheckState(0, Qt::Unchecked);
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    item->setTextAlignment(2, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(0, plainTip(run.note.empty() ? text : text + '\n' + QString::fromStdString(run.note)));
  }
  tree_->resizeColumnToContents(1);
  tree_->resizeColumnToContents(2);
}

void ComparePage::setChosen(const std::vector<Id>& runs) {
  {
    const QSignalBlocker quiet(tree_);
    for (QTreeWidgetItemIterator item(tree_, QTreeWidgetItemIterator::NoChildren); *item; ++item) {
      const bool chosen = std::count(runs.begin(), runs.end(), (*item)->data(0, runRole).toLongLong()) > 0;
      (*item)->setCheckState(0, chosen ? Qt::Checked : Qt::Unchecked);
    }
  }
  draw();
  ask();
}

std::vector<Id> ComparePage::chosen() const {
  std::vector<Id> ids;
  for (QTreeWidgetItemIterator item(tree_, QTreeWidgetItemIterator::NoChildren); *item; ++item)
    if ((*item)->checkState(0) == Qt::Checked) ids.push_back((*item)->data(0, runRole).toLongLong());
  return ids;
}

void ComparePage::showStages(bool on) { charts_->setCurrentWidget(on ? static_cast<QWidget*>(stages_) : plot_); }

void ComparePage::refresh() {
  fresh_.clear();
  ask();
}

// Each run is read once, until refresh().
void ComparePage::ask() {
  std::vector<Id> missing;
  for (const Id id : chosen())
    if (!fresh_.contains(id)) missing.push_back(id);
  if (!missing.empty()) emit wanted(missing);
}

void ComparePage::setHistories(std::map<Id, History> histories, const QString& trouble) {
  trouble_ = trouble;
  for (auto& [id, history] : histories) {
    fresh_.insert(id);
    read_[id] = std::move(history);
  }
  draw();
}

void ComparePage::forget() {
  fresh_.clear();
  read_.clear();
  trouble_.clear();
}

QString ComparePage::experimentOf(const RunRecord& run) const {
  const auto name = experiments_.find(run.experiment);
  return name == experiments_.end() ? tr("Experiment %1").arg(run.experiment) : name->second;
}

QString ComparePage::nameOf(const RunRecord& run) const { return tr("%1, run %2").arg(experimentOf(run)).arg(run.id); }

void ComparePage::draw() {
  std::vector<RunRecord> records, drawn;
  std::vector<FitnessRun> curves;
  QString unit;
  QStringList leftOut, twice;
  bool isMissing = false;
  for (const Id id : chosen()) {
    const auto record = std::find_if(runs_.begin(), runs_.end(), [&](auto& run) { return run.id == id; });
    if (record == runs_.end()) continue;
    records.push_back(*record);
    const auto history = read_.find(id);
    if (history == read_.end()) {
      isMissing = true;
      continue;
    }
    // Metres and centimetres a second on one axis would compare nothing.
    if (curves.empty()) unit = history->second.unit;
    if (history->second.unit != unit) {
      leftOut << tr("run %1 (%2)").arg(id).arg(history->second.unit);
      continue;
    }
    if (joinSeeds_->isChecked())
      if (const auto same =
              std::ranges::find_if(drawn, [&](const RunRecord& other) { return isSameRun(other, *record); });
          same != drawn.end()) {
        twice << tr("run %1 (as run %2)").arg(id).arg(same->id);
        continue;
      }
    FitnessRun curve;
    curve.run = id;
    curve.name = nameOf(*record);
    curve.experiment = experimentOf(*record);
    curve.group = withoutSeed(*record);
    curve.standIn = record->reality == "stand_in";
    curve.generations = history->second.generations;
    curve.simulators = history->second.simulators;
    drawn.push_back(*record);
    curves.push_back(std::move(curve));
  }
  plot_->setData(comparisonPlot(curves, unit, joinSeeds_->isChecked()));
  const std::vector<ComparedArm> arms = armsOf(curves, drawn, read_, joinSeeds_->isChecked());
  stages_->setData(stagePlot(arms, StageQuantity::gap, unit, realityNote(curves)));
  real_->setData(stagePlot(arms, StageQuantity::realFitness, unit, realityNote(curves)));
  fillReached(arms, unit);
  fillDifferences(records);
  QStringList words;
  if (!leftOut.isEmpty())
    words << tr("The charts show fitness in %1; another unit has %2.").arg(unit, leftOut.join(", "));
  if (!twice.isEmpty()) words << tr("A seed counts once; one that is drawn already has %1.").arg(twice.join(", "));
  leftOut_->setText(words.join(' '));
  leftOut_->setVisible(!words.isEmpty());
  summary_->setText(!trouble_.isEmpty() ? trouble_ : isMissing ? tr("Reading…") : differ_);
}

// One row an arm, each at its last stage; differences are to the first arm, paired by seed.
void ComparePage::fillReached(const std::vector<ComparedArm>& arms, const QString& unit) {
  const auto text = [](const Spread& s) {
    if (s.count == 0) return QString();
    return shortNumber(s.mean) + (s.count > 1 ? " ± " + shortNumber(s.halfWidth95) : QString());
  };
  setUpForReading(*reached_,
                  {tr("arm"), tr("stage"), tr("seeds"), axisTitle(tr("gap"), unit), axisTitle(tr("real fitness"), unit),
                   axisTitle(tr("gap − first arm's"), unit), axisTitle(tr("real fitness − first arm's"), unit)});
  reached_->setToolTip(tr("Mean ± half of its 95 % interval over the seeds"));
  reached_->setRowCount(0);
  for (const ComparedArm& arm : arms) {
    if (arm.stages.empty()) continue;
    const ComparedStage& last = arm.stages.back();
    const int row = reached_->rowCount();
    reached_->insertRow(row);
    const QStringList cells{QString::fromStdString(arm.name),
                            QString::number(last.stage),
                            QString::number(last.gap.count),
                            text(last.gap),
                            text(last.realMean),
                            text(last.gapDifference),
                            text(last.realDifference)};
    for (int column = 0; column < int(cells.size()); ++column) {
      auto* item = new QTableWidgetItem(cells[column]);
      if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      reached_->setItem(row, column, item);
    }
  }
  reached_->resizeColumnsToContents();
}

void ComparePage::fillDifferences(const std::vector<RunRecord>& runs) {
  // A run's settings never change.
  QStringList compared{onlyDifferent_->isChecked() ? "differences" : "all"};
  for (const RunRecord& run : runs)
    compared << nameOf(run) << QString::number(run.seed) << QString::fromStdString(run.specJson);
  if (compared == compared_) return;
  compared_ = compared;
  const std::vector<SpecRow> all = compareSpecs(runs);
  std::vector<const SpecRow*> shown;
  for (const SpecRow& row : all)
    if (row.differs || !onlyDifferent_->isChecked()) shown.push_back(&row);

  QStringList header{tr("setting")};
  for (const RunRecord& run : runs) header << nameOf(run);
  differences_->setColumnCount(static_cast<int>(header.size()));
  differences_->setHorizontalHeaderLabels(header);
  differences_->setRowCount(static_cast<int>(shown.size()));
  for (int row = 0; row < static_cast<int>(shown.size()); ++row) {
    const SpecRow& spec = *shown[static_cast<std::size_t>(row)];
    auto* key = new QTableWidgetItem(spec.key);
    QFont bold = key->font();
    bold.setBold(spec.differs);
    key->setFont(bold);
    differences_->setItem(row, 0, key);
    for (int i = 0; i < spec.values.size(); ++i) {
      auto* item = new QTableWidgetItem(spec.values[i]);
      item->setToolTip(spec.values[i]);
      if (spec.values[i] != spec.values[0]) item->setForeground(tonesOf(palette()).accent);
      differences_->setItem(row, i + 1, item);
    }
  }
  differences_->resizeColumnsToContents();

  const auto different = std::count_if(all.begin(), all.end(), [](auto& row) { return row.differs; });
  differ_ = runs.empty()       ? QString()
            : runs.size() == 1 ? tr("%1 settings").arg(all.size())
                               : tr("%1 of %2 settings differ").arg(different).arg(all.size());
}

}  // namespace btr::ui
