#include "ui/experiment/experiment_tree.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QStandardItemModel>
#include <QTreeView>
#include <QVBoxLayout>

#include "core/run/adoption.h"
#include "ui/common/theme.h"
#include "ui/experiment/badge_delegate.h"
#include "ui/experiment/run_text.h"

namespace btr::ui {
namespace {

constexpr int KindRole = Qt::UserRole + 1;
constexpr int IdRole = Qt::UserRole + 2;

int kindOf(const QModelIndex& index) { return index.siblingAtColumn(0).data(KindRole).toInt(); }
Id idOf(const QModelIndex& index) { return index.siblingAtColumn(0).data(IdRole).toLongLong(); }
QString text(const std::string& plain) { return QString::fromStdString(plain); }

}  // namespace

ExperimentTree::ExperimentTree(QWidget* parent)
    : QWidget(parent), view_(new QTreeView(this)), model_(new QStandardItemModel(0, 3, this)) {
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
  view_->setIndentation(16);
  view_->setIconSize({18, 18});
  setMinimumWidth(200);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(view_);

  connect(view_, &QWidget::customContextMenuRequested, this, &ExperimentTree::openMenu);
  connect(view_, &QTreeView::activated, this, &ExperimentTree::activate);
  connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this,
          [this](const QModelIndex& index) { current(index); });
  // F2 edits the note, the menu key opens the menu where the selection is.
  auto* note = new QAction(tr("Edit note…"), view_);
  note->setShortcut(Qt::Key_F2);
  note->setShortcutContext(Qt::WidgetShortcut);
  view_->addAction(note);
  connect(note, &QAction::triggered, this, [this] {
    const QModelIndex index = view_->currentIndex();
    if (kindOf(index) == experimentKind)
      emit experimentNoteRequested(idOf(index));
    else if (const Id run = selectedRun())
      emit runNoteRequested(run);
  });
}

void ExperimentTree::setContent(const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs,
                                const std::vector<RunGroup>& groups) {
  QStandardItem& root = *model_->invisibleRootItem();
  std::set<Id> experimentIds, runIds, groupIds;
  for (const auto& experiment : experiments) experimentIds.insert(experiment.id);
  keepOnly(root, experimentKind, experimentIds);
  for (const auto& experiment : experiments) {
    const bool isNew = model_->match(model_->index(0, 0), IdRole, qint64(experiment.id), 1, Qt::MatchExactly).isEmpty();
    QStandardItem* item = child(root, experimentKind, experiment.id);
    item->setText(text(experiment.name));
    if (!experiment.note.empty() && !rigs_.count(experiment.id))
      item->setData(text(experiment.note), BadgeDelegate::DetailRole);
    item->setIcon(themeIcon("folder-open"));
    item->setToolTip(tr("Experiment %1, stored %2").arg(text(experiment.name), text(experiment.createdAt)) +
                     (experiment.note.empty() ? QString() : "\n" + text(experiment.note)));
    if (isNew) view_->expand(item->index());
  }
  runs_.clear();
  for (const auto& run : runs) {
    runs_[run.id] = run;
    runIds.insert(run.id);
  }
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
}

void ExperimentTree::showGroup(QStandardItem& item, const RunGroup& group) {
  if (item.text() == group.name) return;
  item.setText(group.name);
  item.setIcon(themeIcon("view-grid"));
  item.setData(tr("%1 cells").arg(group.cells.size()), BadgeDelegate::DetailRole);
  item.setToolTip(tr("Grid %1: %2\nEnter opens it in “The whole kick”").arg(group.grid).arg(group.name));
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
  const RunProgress progress = progressFromJson(run.progressJson);
  const RunFace face = faceOf(run, active_.count(run.id) > 0);
  const auto set = [](QStandardItem* cell, const QString& value) {
    if (cell->text() != value) cell->setText(value);
  };
  const auto cell = cells_.find(run.id);
  set(&item, (cell == cells_.end() ? runName(run) : tr("Cell %1 · %2").arg(cell->second).arg(runName(run))) +
                 (run.note.empty() ? QString() : QStringLiteral(" — ") + text(run.note)));
  item.setIcon(themeIcon(iconName(face)));
  item.setData(isStandIn(run) ? tr("stand-in") : QString(), BadgeDelegate::BadgeRole);
  item.setToolTip(tr("%1\n%2\nStarted %3, version %4")
                      .arg(runName(run), stageText(face, progress), text(run.startedAt), text(run.programVersion)) +
                  (isStandIn(run) ? tr("\nStand-in reality: no real robot was measured") : QString()) +
                  (run.note.empty() ? QString() : "\n" + text(run.note)));
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

void ExperimentTree::openMenu(const QPoint& position) {
  const QModelIndex index = view_->indexAt(position);
  QMenu menu(this);
  if (kindOf(index) == experimentKind) {
    menu.addAction(themeIcon("edit-rename"), tr("Edit note…"), this,
                   [this, id = idOf(index)] { emit experimentNoteRequested(id); });
    if (!rigs_.count(idOf(index)))
      menu.addAction(themeIcon("office-chart-line"), tr("Compare its runs"), this,
                     [this, id = idOf(index)] { emit compareRequested(runsOf(id)); });
  } else if (kindOf(index) == groupKind) {
    menu.addAction(themeIcon("view-grid"), tr("Show in “The whole kick”"), this,
                   [this, id = idOf(index)] { emit gridRequested(id); });
  } else if (const Id run = selectedRun()) {
    fillRunMenu(menu, run);
  }
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
