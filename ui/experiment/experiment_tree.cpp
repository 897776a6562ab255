#include "ui/experiment/experiment_tree.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QStandardItemModel>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/run/reality/adoption.h"
#include "ui/common/look/plain_tip.h"
#include "ui/common/look/theme.h"
#include "ui/experiment/badge_delegate.h"
#include "ui/experiment/run_text.h"

namespace btr::ui {
namespace {

constexpr int KindRole = Qt::UserRole + 1;
constexpr int IdRole = Qt::UserRole + 2;
constexpr int SortRole = Qt::UserRole + 20;
enum Order { byStoring, newestFirst, byName };

int kindOf(const QModelIndex& index) { return index.siblingAtColumn(0).data(KindRole).toInt(); }
Id idOf(const QModelIndex& index) { return index.siblingAtColumn(0).data(IdRole).toLongLong(); }
QString text(const std::string& plain) { return QString::fromStdString(plain); }

}  // namespace

ExperimentTree::ExperimentTree(QWidget* parent)
    : QWidget(parent),
      view_(new QTreeView(this)),
      search_(new QLineEdit(this)),
      order_(new QComboBox(this)),
      archive_(new QToolButton(this)),
      model_(new QStandardItemModel(0, 3, this)) {
  model_->setSortRole(SortRole);
  model_->setHorizontalHeaderLabels({tr("Experiment"), tr("Generation"), tr("State")});
  view_->setModel(model_);
  view_->setObjectName("experimentTree");
  view_->setAccessibleName(tr("Experiments and runs"));
  view_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  view_->setContextMenuPolicy(Qt::CustomContextMenu);
  view_->setFrameShape(QFrame::NoFrame);
  view_->setItemDelegateForColumn(0, new BadgeDelegate(view_));
  // The other columns stand in the second line of each item; as columns they serve readers and tests.
  view_->setColumnHidden(1, true);
  view_->setColumnHidden(2, true);
  view_->setHeaderHidden(true);
  view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  view_->setIndentation(16);
  view_->setIconSize({18, 18});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(makeBar());
  column->addWidget(view_);

  connect(view_, &QWidget::customContextMenuRequested, this, &ExperimentTree::openMenu);
  connect(view_, &QTreeView::activated, this, &ExperimentTree::activate);
  connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this,
          [this](const QModelIndex& index) { current(index); });
  // F2 renames an experiment and edits the note of a run, the menu key opens the menu where the selection is.
  auto* note = new QAction(tr("Rename, or edit note…"), view_);
  note->setShortcut(Qt::Key_F2);
  note->setShortcutContext(Qt::WidgetShortcut);
  view_->addAction(note);
  connect(note, &QAction::triggered, this, [this] {
    const QModelIndex index = view_->currentIndex();
    if (kindOf(index) == experimentKind)
      emit renameRequested(idOf(index));
    else if (const Id run = selectedRun())
      emit runNoteRequested(run);
  });
}

QWidget* ExperimentTree::makeBar() {
  auto* bar = new QWidget(this);
  auto* column = new QVBoxLayout(bar);
  column->setContentsMargins(4, 2, 4, 4);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  search_->setObjectName("searchExperiments");
  search_->setPlaceholderText(tr("Search"));
  search_->setAccessibleName(tr("Search experiments and runs"));
  search_->setToolTip(tr("Shows what has this text in its name, note or state"));
  search_->setClearButtonEnabled(true);
  order_->setObjectName("orderExperiments");
  order_->addItems({tr("Oldest first"), tr("Newest first"), tr("By name")});
  order_->setAccessibleName(tr("Order of the experiments"));
  order_->setFocusPolicy(Qt::StrongFocus);
  order_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  order_->setMinimumContentsLength(6);
  archive_->setObjectName("showArchive");
  archive_->setIcon(themeIcon("view-hidden"));
  archive_->setCheckable(true);
  archive_->setAutoRaise(true);
  archive_->setToolTip(tr("Also show archived experiments"));
  archive_->setAccessibleName(tr("Show archived experiments"));
  column->addWidget(search_);
  column->addLayout(row);
  row->addWidget(order_, 1);
  row->addWidget(archive_);
  connect(search_, &QLineEdit::textChanged, this, &ExperimentTree::filter);
  connect(archive_, &QToolButton::toggled, this, &ExperimentTree::filter);
  connect(order_, &QComboBox::currentIndexChanged, this, [this] {
    sort();
    filter();
  });
  return bar;
}

// Experiments of one name are told apart by when they were stored.
void ExperimentTree::nameExperiments(const std::vector<ExperimentRecord>& experiments) {
  std::map<std::string, int> count;
  for (const auto& experiment : experiments) ++count[experiment.name];
  for (const auto& experiment : experiments) {
    QStandardItem* item = child(*model_->invisibleRootItem(), experimentKind, experiment.id);
    QStringList words;
    if (count[experiment.name] > 1)
      words << tr("number %1, stored %2").arg(experiment.id).arg(text(experiment.createdAt).left(16).replace('T', ' '));
    if (!experiment.note.empty()) words << text(experiment.note);
    if (archived_.count(experiment.id)) words << tr("archived");
    if (!rigs_.count(experiment.id)) item->setData(words.join(" · "), BadgeDelegate::DetailRole);
  }
}

void ExperimentTree::setArchived(const std::set<Id>& experiments) {
  archived_ = experiments;
  filter();
}

void ExperimentTree::archive(const std::vector<Id>& experiments, bool away) {
  for (const Id experiment : experiments)
    if (away)
      archived_.insert(experiment);
    else
      archived_.erase(experiment);
  filter();
  emit archivedChanged(archived_);
}

// Runs stay in the order in which they were stored.
void ExperimentTree::sort() {
  const int order = order_->currentIndex();
  const QStandardItem& root = *model_->invisibleRootItem();
  std::vector<std::pair<QString, Id>> names;
  for (int row = 0; row < root.rowCount(); ++row)
    names.emplace_back(root.child(row)->text().toLower(), idOf(root.child(row)->index()));
  std::ranges::sort(names);
  const auto setKeys = [](const auto& self, const QStandardItem& parent) -> void {
    for (int row = 0; row < parent.rowCount(); ++row) {
      // Runs before simulators, as they came.
      parent.child(row)->setData(row, SortRole);
      self(self, *parent.child(row));
    }
  };
  setKeys(setKeys, root);
  for (int row = 0; row < root.rowCount(); ++row) {
    const Id id = idOf(root.child(row)->index());
    const auto place = std::ranges::find(names, id, [](const auto& entry) { return entry.second; });
    const qlonglong key = order == byName        ? place - names.begin()
                          : order == newestFirst ? -qlonglong(id)
                                                 : qlonglong(id);
    root.child(row)->setData(key, SortRole);
  }
  model_->sort(0);
}

void ExperimentTree::filter() { filterChildren(*model_->invisibleRootItem(), search_->text().trimmed()); }

// True if something below is shown. What is below a hit is shown whole.
bool ExperimentTree::filterChildren(const QStandardItem& parent, const QString& wanted) {
  bool any = false;
  const bool atTop = &parent == model_->invisibleRootItem();
  for (int row = 0; row < parent.rowCount(); ++row) {
    const QStandardItem& item = *parent.child(row);
    const QString words = item.text() + ' ' + item.data(BadgeDelegate::DetailRole).toString() + ' ' +
                          item.data(BadgeDelegate::BadgeRole).toString() + ' ' + item.toolTip();
    const bool hit = words.contains(wanted, Qt::CaseInsensitive);
    const bool below = filterChildren(item, hit ? QString() : wanted);
    // Setting it lays the whole tree out anew.
    const bool away = atTop && archived_.count(idOf(item.index())) > 0 && !archive_->isChecked();
    const bool hide = away || (!hit && !below);
    if (view_->isRowHidden(row, parent.index()) != hide) view_->setRowHidden(row, parent.index(), hide);
    any = any || hit || below;
  }
  return any;
}

void ExperimentTree::setContent(const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs,
                                const std::vector<RunGroup>& groups) {
  QStandardItem& root = *model_->invisibleRootItem();
  std::set<Id> experimentIds, runIds, groupIds;
  for (const auto& experiment : experiments) experimentIds.insert(experiment.id);
  keepOnly(root, experimentKind, experimentIds);
  for (const auto& experiment : experiments) {
    const int before = root.rowCount();
    QStandardItem* item = child(root, experimentKind, experiment.id);
    const bool isNew = root.rowCount() > before;
    item->setText(text(experiment.name));
    if (isNew) item->setIcon(themeIcon("folder-open"));
    item->setToolTip(plainTip(tr("Experiment %1, stored %2").arg(text(experiment.name), text(experiment.createdAt)) +
                              (experiment.note.empty() ? QString() : "\n" + text(experiment.note))));
    if (isNew) view_->expand(item->index());
  }
  runs_.clear();
  for (const auto& run : runs) {
    runs_[run.id] = run;
    runIds.insert(run.id);
  }
  std::erase_if(shown_, [&](const auto& shown) { return !runIds.count(shown.first); });
  cells_.clear();
  std::map<Id, const RunGroup*> groupOf;
  for (const RunGroup& group : groups) {
    groupIds.insert(group.grid);
    for (const auto& [run, cell] : group.cells) {
      groupOf[run] = &group;
      cells_[run] = cell;
    }
  }
  // A run stands either alone or in its group.
  std::set<Id> alone;
  for (const Id run : runIds)
    if (!groupOf.count(run)) alone.insert(run);
  runItems_.clear();
  for (int row = 0; row < root.rowCount(); ++row) {
    QStandardItem& experiment = *root.child(row);
    keepOnly(experiment, runKind, alone);
    keepOnly(experiment, groupKind, groupIds);
    for (int k = 0; k < experiment.rowCount(); ++k)
      if (kindOf(experiment.child(k)->index()) == groupKind) keepOnly(*experiment.child(k), runKind, runIds);
  }
  for (const auto& run : runs) {
    QStandardItem* parent = child(root, experimentKind, run.experiment);
    if (const auto group = groupOf.find(run.id); group != groupOf.end()) {
      parent = child(*parent, groupKind, group->second->grid);
      showGroup(*parent, *group->second);
    }
    QStandardItem* item = child(*parent, runKind, run.id);
    runItems_[run.id] = item;
    showRun(*item, run);
  }
  nameExperiments(experiments);
  if (order_->currentIndex() != byStoring) sort();
  filter();
}

void ExperimentTree::showGroup(QStandardItem& item, const RunGroup& group) {
  if (item.text() == group.name) return;
  item.setText(group.name);
  item.setIcon(themeIcon("view-grid"));
  item.setData(tr("%1 cells").arg(group.cells.size()), BadgeDelegate::DetailRole);
  item.setToolTip(plainTip(tr("Grid %1: %2\nEnter opens it in “The whole kick”").arg(group.grid).arg(group.name)));
}

void ExperimentTree::setSimulators(Id run, const std::vector<SimulatorRecord>& simulators) {
  const auto found = runItems_.find(run);
  if (found == runItems_.end()) return;
  std::set<Id> ids;
  for (const auto& simulator : simulators) ids.insert(simulator.id);
  keepOnly(*found->second, simulatorKind, ids);
  for (const auto& simulator : simulators) {
    const QString detail =
        simulator.madeAfterGeneration > 0
            ? tr("%1, after generation %2").arg(text(originOf(simulator))).arg(simulator.madeAfterGeneration)
            : text(originOf(simulator));
    QStandardItem* item = showSimulator(*found->second, simulator, detail);
    found->second->child(item->row(), 1)->setText(QString::number(simulator.madeAfterGeneration));
    item->setToolTip(tr("Simulator version %1, made by %2 after generation %3")
                         .arg(simulator.number)
                         .arg(text(originOf(simulator)))
                         .arg(simulator.madeAfterGeneration));
  }
}

void ExperimentTree::setRigs(const std::vector<SimulatorRecord>& versions) {
  rigs_.clear();
  // By number, so that the newest one is told last.
  for (const SimulatorRecord& version : versions) {
    rigs_.insert(version.rig);
    QStandardItem* rig = child(*model_->invisibleRootItem(), experimentKind, version.rig);
    rig->setData(tr("rig · simulator version %1").arg(version.number), BadgeDelegate::DetailRole);
    showSimulator(*rig, version, version.number == 0 ? tr("the scene as given") : text(originOf(version)))
        ->setToolTip(tr("Simulator version %1 of %2, made by %3")
                         .arg(QString::number(version.number), rig->text(), text(originOf(version))));
  }
}

QStandardItem* ExperimentTree::showSimulator(QStandardItem& parent, const SimulatorRecord& simulator,
                                             const QString& detail) {
  QStandardItem* item = child(parent, simulatorKind, simulator.id);
  item->setText(tr("Simulator %1").arg(simulator.number));
  item->setIcon(themeIcon("cpu"));
  item->setData(detail, BadgeDelegate::DetailRole);
  parent.child(item->row(), 2)->setText(text(originOf(simulator)));
  return item;
}

void ExperimentTree::setActive(const std::set<Id>& active) {
  active_ = active;
  for (const auto& [id, item] : runItems_) showRun(*item, runs_.at(id));
}

void ExperimentTree::selectRun(Id run) {
  const auto found = runItems_.find(run);
  if (found == runItems_.end() || selectedRun() == run) return;
  quiet_ = true;
  view_->setCurrentIndex(found->second->index());
  view_->scrollTo(found->second->index());
  quiet_ = false;
}

Id ExperimentTree::selectedRun() const {
  const QModelIndex index = view_->currentIndex();
  if (kindOf(index) == runKind) return idOf(index);
  if (kindOf(index) == simulatorKind && kindOf(index.parent()) == runKind) return idOf(index.parent());
  return 0;
}

Id ExperimentTree::selectedRig() const {
  QModelIndex index = view_->currentIndex();
  if (kindOf(index) == simulatorKind) index = index.parent();
  return kindOf(index) == experimentKind && rigs_.count(idOf(index)) ? idOf(index) : 0;
}

// Finds the row by its id or appends it; the three columns exist from the start.
QStandardItem* ExperimentTree::child(QStandardItem& parent, Kind kind, Id id) {
  for (int row = 0; row < parent.rowCount(); ++row)
    if (parent.child(row)->data(KindRole).toInt() == kind && parent.child(row)->data(IdRole).toLongLong() == id)
      return parent.child(row);
  auto* item = new QStandardItem;
  item->setData(int(kind), KindRole);
  item->setData(qint64(id), IdRole);
  auto* generation = new QStandardItem;
  generation->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  parent.appendRow({item, generation, new QStandardItem});
  return item;
}

void ExperimentTree::keepOnly(QStandardItem& parent, Kind kind, const std::set<Id>& ids) {
  for (int row = parent.rowCount() - 1; row >= 0; --row)
    if (parent.child(row)->data(KindRole).toInt() == kind && !ids.count(parent.child(row)->data(IdRole).toLongLong()))
      parent.removeRow(row);
}

void ExperimentTree::showRun(QStandardItem& item, const RunRecord& run) {
  const auto cell = cells_.find(run.id);
  // Most runs of a large database have not changed since they were shown.
  const QString all = QStringLiteral("%1 %2 %3 %4 %5 %6 %7 %8 %9")
                          .arg(toText(run.state))
                          .arg(run.stage)
                          .arg(run.generation)
                          .arg(run.stopRequested)
                          .arg(active_.count(run.id))
                          .arg(cell == cells_.end() ? -1 : cell->second)
                          .arg(text(run.progressJson), text(run.message), text(run.note));
  if (std::exchange(shown_[run.id], {&item, all}) == std::pair(&item, all)) return;
  const RunProgress progress = progressFromJson(run.progressJson);
  const RunFace face = faceOf(run, active_.count(run.id) > 0);
  const auto set = [](QStandardItem* shownItem, const QString& value) {
    if (shownItem->text() != value) shownItem->setText(value);
  };
  set(&item, (cell == cells_.end() ? runName(run) : tr("Cell %1 · %2").arg(cell->second).arg(runName(run))) +
                 (run.note.empty() ? QString() : QStringLiteral(" — ") + text(run.note)));
  item.setIcon(themeIcon(iconName(face)));
  item.setData(isStandIn(run) ? tr("stand-in") : QString(), BadgeDelegate::BadgeRole);
  item.setToolTip(
      plainTip(tr("%1\n%2\nStarted %3, version %4")
                   .arg(runName(run), stageText(face, progress), text(run.startedAt), text(run.programVersion)) +
               (isStandIn(run) ? tr("\nStand-in reality: no real robot was measured") : QString()) +
               (run.note.empty() ? QString() : "\n" + text(run.note))));
  QStandardItem& parent = *item.parent();
  set(parent.child(item.row(), 1), progress.totalGenerations > 0
                                       ? QStringLiteral("%1 / %2").arg(run.generation).arg(progress.totalGenerations)
                                       : QString::number(run.generation));
  const QString full = stageText(face, progress);
  QString brief = face == RunFace::learning   ? tr("learning")
                  : face == RunFace::adapting ? tr("adapting")
                  : face == RunFace::waiting  ? tr("waiting")
                                              : full.toLower();
  if (face == RunFace::ready) brief = tr("ready");
  set(parent.child(item.row(), 2), brief);
  const QString detail = brief + QStringLiteral(" · ") + tr("generation %1").arg(parent.child(item.row(), 1)->text());
  if (item.data(BadgeDelegate::DetailRole).toString() != detail) item.setData(detail, BadgeDelegate::DetailRole);
}

void ExperimentTree::fillRunMenu(QMenu& menu, Id run) {
  const auto found = runs_.find(run);
  if (found == runs_.end()) return;
  const RunFace face = faceOf(found->second, active_.count(run) > 0);
  const bool works = active_.count(run) > 0;
  auto* go = menu.addAction(themeIcon("media-playback-start"), face == RunFace::ready ? tr("Start") : tr("Continue"),
                            this, [this, run] { emit continueRequested(run); });
  go->setEnabled(!works && face != RunFace::finished);
  menu.addAction(themeIcon("media-playback-stop"), tr("Stop"), this, [this, run] { emit stopRequested(run); })
      ->setEnabled(works && face != RunFace::stopping);
  menu.addSeparator();
  menu.addAction(themeIcon("document-properties"), tr("Show settings"), this, [this, run] { emit specRequested(run); });
  menu.addAction(themeIcon("edit-copy"), tr("Duplicate with another seed…"), this,
                 [this, run] { emit duplicateRequested(run); });
  menu.addAction(themeIcon("edit-rename"), tr("Edit note…"), this, [this, run] { emit runNoteRequested(run); });
  menu.addAction(themeIcon("office-chart-line"), tr("Compare"), this, [this, run] { emit compareRequested({run}); });
  QMenu* exports = menu.addMenu(themeIcon("document-export"), tr("Export as CSV"));
  for (const auto& [what, label] :
       {std::pair{"generations", tr("Generations…")}, std::pair{"individuals", tr("Individuals…")},
        std::pair{"gaps", tr("Reality gaps…")}, std::pair{"simulators", tr("Simulator versions…")},
        std::pair{"policies", tr("Policies of L2…")}, std::pair{"steps", tr("Steps of L2…")}})
    exports->addAction(label, this, [this, run, name = QString(what)] { emit exportRequested(run, name); });
}

std::vector<Id> ExperimentTree::runsOf(Id experiment) const {
  std::vector<Id> ids;
  for (const auto& [id, run] : runs_)
    if (run.experiment == experiment) ids.push_back(id);
  return ids;
}

std::vector<Id> ExperimentTree::chosen(Kind kind) const {
  std::vector<Id> ids;
  for (const QModelIndex& index : view_->selectionModel()->selectedRows())
    if (kindOf(index) == kind) ids.push_back(idOf(index));
  std::ranges::sort(ids);
  return ids;
}

void ExperimentTree::fillRunsMenu(QMenu& menu, const std::vector<Id>& runs) {
  menu.addAction(themeIcon("office-chart-line"), tr("Compare these %1 runs").arg(runs.size()), this,
                 [this, runs] { emit compareRequested(runs); });
  menu.addSeparator();
  const auto goesOn = [this](Id run) { return runs_.at(run).state != RunState::finished && active_.count(run) == 0; };
  const auto works = [this](Id run) { return active_.count(run) > 0; };
  menu.addAction(themeIcon("media-playback-start"), tr("Continue them"), this,
                 [this, runs, goesOn] {
                   for (const Id run : runs)
                     if (goesOn(run)) emit continueRequested(run);
                 })
      ->setEnabled(std::ranges::any_of(runs, goesOn));
  menu.addAction(themeIcon("media-playback-stop"), tr("Stop them"), this,
                 [this, runs, works] {
                   for (const Id run : runs)
                     if (works(run)) emit stopRequested(run);
                 })
      ->setEnabled(std::ranges::any_of(runs, works));
}

void ExperimentTree::fillExperimentsMenu(QMenu& menu, const std::vector<Id>& experiments) {
  if (experiments.size() == 1) {
    menu.addAction(themeIcon("edit-rename"), tr("Rename…"), this,
                   [this, id = experiments.front()] { emit renameRequested(id); });
    menu.addAction(themeIcon("document-edit"), tr("Edit note…"), this,
                   [this, id = experiments.front()] { emit experimentNoteRequested(id); });
  }
  std::vector<Id> runs;
  for (const Id experiment : experiments)
    for (const Id run : runsOf(experiment)) runs.push_back(run);
  if (!runs.empty())
    menu.addAction(themeIcon("office-chart-line"),
                   experiments.size() == 1 ? tr("Compare its runs") : tr("Compare their runs"), this,
                   [this, runs] { emit compareRequested(runs); });
  const bool away = std::ranges::all_of(experiments, [&](Id id) { return archived_.count(id) > 0; });
  menu.addAction(themeIcon("archive-insert"), away ? tr("Take out of the archive") : tr("Archive"), this,
                 [this, experiments, away] { archive(experiments, !away); });
}

void ExperimentTree::fillMenu(QMenu& menu) {
  const std::vector<Id> experiments = chosen(experimentKind), runs = chosen(runKind);
  const QModelIndex index = view_->currentIndex();
  if (!experiments.empty() && runs.empty())
    fillExperimentsMenu(menu, experiments);
  else if (runs.size() > 1)
    fillRunsMenu(menu, runs);
  else if (kindOf(index) == groupKind)
    menu.addAction(themeIcon("view-grid"), tr("Show in “The whole kick”"), this,
                   [this, id = idOf(index)] { emit gridRequested(id); });
  else if (const Id run = selectedRun())
    fillRunMenu(menu, run);
}

void ExperimentTree::openMenu(const QPoint& position) {
  if (!view_->indexAt(position).isValid()) return;
  QMenu menu(this);
  fillMenu(menu);
  if (!menu.isEmpty()) menu.exec(view_->viewport()->mapToGlobal(position));
}

void ExperimentTree::current(const QModelIndex& index) {
  if (quiet_) return;
  const bool simulator = kindOf(index) == simulatorKind;
  if (const Id rig = selectedRig()) return emit rigSelected(rig, simulator ? idOf(index) : 0);
  if (const Id run = selectedRun()) emit runSelected(run);
  if (simulator) emit simulatorSelected(idOf(index.parent()), idOf(index));
}

void ExperimentTree::activate(const QModelIndex& index) {
  if (kindOf(index) == runKind) emit specRequested(idOf(index));
  if (kindOf(index) == groupKind) emit gridRequested(idOf(index));
}

}  // namespace btr::ui
