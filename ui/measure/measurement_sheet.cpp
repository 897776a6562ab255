#include "ui/measure/measurement_sheet.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QToolButton>
#include <algorithm>

#include "core/gap/proof/proof_marks.h"
#include "ui/charts/plot_data.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/look/theme.h"
#include "ui/measure/measurement_view.h"
#include "ui/measure/question_bar.h"

namespace btr::ui {

MeasurementSheet::MeasurementSheet(QWidget* parent)
    : QWidget(parent),
      view_(new MeasurementView(model_, this)),
      banner_(new MessageBanner(this)),
      question_(new QuestionBar(this)) {
  stage_ = new QComboBox(this);
  stage_->setObjectName("stage");
  stage_->setAccessibleName(tr("Stage"));
  stage_->setToolTip(tr("Which stage or iteration of L2 is shown; earlier ones can be looked at and corrected"));
  stage_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  connect(stage_, &QComboBox::activated, this, [this](int index) { showStage(static_cast<std::size_t>(index)); });
  title_ = new QLabel(this);
  title_->setObjectName("title");
  title_->setWordWrap(true);
  auto* head = new QHBoxLayout;
  head->addWidget(stage_);
  head->addWidget(title_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addLayout(head);
  layout->addWidget(makeToolBar());
  layout->addWidget(view_, 1);
  layout->addWidget(question_);
  layout->addWidget(banner_);  // above the rows it would push them from under the hand that types
  layout->addWidget(makeFooter());

  connect(&model_, &MeasurementModel::changed, this, &MeasurementSheet::refresh);
  connect(&model_, &MeasurementModel::converted, this, [this](const QString& message) {
    saysEdit_ = true;
    banner_->showMessage(MessageBanner::Kind::information, tr("Decimal comma: %1").arg(message));
  });
  connect(&model_, &MeasurementModel::refused, this, [this](int row, const QString& why) {
    const auto at = static_cast<std::size_t>(row);
    saysRefused_ = true;
    saysEdit_ = false;
    banner_->showMessage(MessageBanner::Kind::error,
                         tr("Individual %1: %2").arg(model_.rows()[at].task.individual).arg(why));
  });
  // The rows that it takes are the last ones: the current one stays in sight.
  connect(
      banner_, &MessageBanner::shown, view_, [this] { view_->scrollTo(view_->currentIndex()); }, Qt::QueuedConnection);
  connect(&model_.undoStack(), &QUndoStack::indexChanged, this, &MeasurementSheet::editsChanged);
  connect(view_, &MeasurementView::leftOut, this, &MeasurementSheet::sayLeftOut);
  connect(view_, &MeasurementView::unclear, this, &MeasurementSheet::sayUnclear);
  connect(question_, &QuestionBar::answered, this, [this](bool yes) {
    view_->setFocus();
    if (yes)
      store();
    else if (asked_.isValid())
      view_->setCurrentIndex(asked_);
  });
  connect(view_, &MeasurementView::replayRequested, this, &MeasurementSheet::replayRequested);
  connect(view_, &MeasurementView::voidRequested, this, &MeasurementSheet::askVoid);
  connect(view_, &MeasurementView::parametersRequested, this, &MeasurementSheet::parametersRequested);
  setWho(qEnvironmentVariable("USER"));
  setFocusProxy(view_);
  refresh();
}

QAction* MeasurementSheet::addKey(const QString& text, const char* icon, const QKeySequence& keys) {
  auto* action = new QAction(themeIcon(icon), text, this);
  action->setShortcut(keys);
  action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  action->setToolTip(text + " (" + keys.toString(QKeySequence::NativeText) + ')');
  addAction(action);
  return action;
}

QWidget* MeasurementSheet::makeToolBar() {
  auto* bar = new QWidget(this);
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(0, 0, 0, 0);
  const auto button = [&](QAction* action, Qt::ToolButtonStyle style) {
    auto* tool = new QToolButton(bar);
    tool->setDefaultAction(action);
    tool->setToolButtonStyle(style);
    tool->setAutoRaise(true);
    layout->addWidget(tool);
  };
  undo_ = addKey(tr("Undo"), "edit-undo", QKeySequence::Undo);
  redo_ = addKey(tr("Redo"), "edit-redo", QKeySequence("Ctrl+Y"));
  redo_->setShortcuts({QKeySequence("Ctrl+Y"), QKeySequence("Ctrl+Shift+Z")});
  connect(undo_, &QAction::triggered, &model_.undoStack(), &QUndoStack::undo);
  connect(redo_, &QAction::triggered, &model_.undoStack(), &QUndoStack::redo);
  button(undo_, Qt::ToolButtonIconOnly);
  button(redo_, Qt::ToolButtonIconOnly);

  QAction* repeat = addKey(tr("Add repeat"), "list-add", QKeySequence("Ctrl++"));
  connect(repeat, &QAction::triggered, &model_, &MeasurementModel::addRepeatColumn);
  button(repeat, Qt::ToolButtonTextBesideIcon);
  QAction* import = addKey(tr("Import CSV…"), "document-import", QKeySequence("Ctrl+I"));
  connect(import, &QAction::triggered, this, &MeasurementSheet::importRequested);
  button(import, Qt::ToolButtonTextBesideIcon);

  showSimulated_ = new QCheckBox(tr("Show simulated fitness"), bar);
  showSimulated_->setToolTip(
      tr("Hidden until everything is entered: who knows the simulated value tends to see it in reality "
         "too, stops a bad trial early or repeats it. Blind values keep the reality gap honest."));
  connect(showSimulated_, &QCheckBox::toggled, &model_, &MeasurementModel::setSimulatedShown);
  layout->addSpacing(8);
  layout->addWidget(showSimulated_);
  layout->addStretch(1);

  auto* label = new QLabel(tr("Measured &by"), bar);
  who_ = new QLineEdit(bar);
  who_->setMaximumWidth(140);
  who_->setToolTip(tr("Stored with every value"));
  label->setBuddy(who_);
  layout->addWidget(label);
  layout->addWidget(who_);
  return bar;
}

QWidget* MeasurementSheet::makeFooter() {
  auto* bar = new QWidget(this);
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(0, 0, 0, 0);
  progressText_ = new QLabel(bar);
  progress_ = new QProgressBar(bar);
  progress_->setTextVisible(false);
  progress_->setMaximumWidth(180);
  layout->addWidget(progress_);
  layout->addWidget(progressText_, 1);

  saveAction_ = addKey(tr("Save measurements"), "document-save", QKeySequence::Save);
  connect(saveAction_, &QAction::triggered, this, &MeasurementSheet::save);
  save_ = new QPushButton(saveAction_->icon(), saveAction_->text(), bar);
  save_->setToolTip(tr("Stores what is entered (Ctrl+S). Stored values are corrected by voiding them."));
  connect(save_, &QPushButton::clicked, this, &MeasurementSheet::save);
  continue_ = new QPushButton(themeIcon("media-playback-start"), tr("Start learning again"), bar);
  connect(continue_, &QPushButton::clicked, this, &MeasurementSheet::continueRequested);
  layout->addWidget(save_);
  layout->addWidget(continue_);
  return bar;
}

void MeasurementSheet::setUnit(const QString& unit) { model_.setUnit(unit); }
void MeasurementSheet::setAllowed(const AllowedRange& allowed) { model_.setAllowed(allowed); }
void MeasurementSheet::setWho(const QString& who) { who_->setText(who); }
QString MeasurementSheet::who() const { return who_->text().trimmed(); }

void MeasurementSheet::setStandIn(bool standIn) {
  standIn_ = standIn;
  refresh();
}

void MeasurementSheet::setTasks(const std::vector<MeasurementTask>& tasks) {
  finishEditing();
  const auto apart = [](const MeasurementTask& a, const MeasurementTask& b) {
    return a.run != b.run || a.stage != b.stage || a.iteration != b.iteration;
  };
  const bool wasNewest = isNewest();
  const auto looked = stages_.empty() ? MeasurementTask() : stages_[shown_].front();
  stages_.clear();
  for (const MeasurementTask& task : tasks) {
    if (stages_.empty() || apart(stages_.back().front(), task)) stages_.emplace_back();
    stages_.back().push_back(task);
  }
  const auto same =
      std::find_if(stages_.begin(), stages_.end(), [&](const auto& stage) { return !apart(stage.front(), looked); });
  if (!tasks.empty() && tasks.front().run != looked.run) banner_->clear();
  const bool stays = !wasNewest && same != stages_.end();
  fillStages(stays ? static_cast<std::size_t>(same - stages_.begin()) : stages_.empty() ? 0 : stages_.size() - 1);
}

void MeasurementSheet::fillStages(std::size_t shown) {
  const QSignalBlocker quiet(stage_);
  stage_->clear();
  for (const auto& stage : stages_) {
    const MeasurementTask& task = stage.front();
    stage_->addItem(task.iteration > 0 ? tr("Stage %1, L2, iteration %2").arg(task.stage).arg(task.iteration)
                                       : tr("Stage %1").arg(task.stage));
  }
  stage_->setVisible(stages_.size() > 1);
  showStage(shown);
}

void MeasurementSheet::showStage(std::size_t index) {
  finishEditing();
  question_->withdraw();
  if (index != shown_) clearSaidOfEdit();  // it was about another stage
  shown_ = index;
  stage_->setCurrentIndex(stages_.empty() ? -1 : static_cast<int>(index));
  model_.setTasks(stages_.empty() ? std::vector<MeasurementTask>() : stages_[index]);
  refresh();
}

void MeasurementSheet::showNewest() {
  if (!stages_.empty()) showStage(stages_.size() - 1);
}

void MeasurementSheet::setDraft(const MeasurementDraft& draft) {
  if (draft.empty()) return;
  model_.setDraft(draft);
  saysEdit_ = true;
  banner_->showMessage(MessageBanner::Kind::information,
                       tr("What was entered here and not saved yet stands in the sheet again."));
}

// The editor gives its text to the model when it loses the focus.
void MeasurementSheet::finishEditing() {
  const QWidget* focus = QApplication::focusWidget();
  if (focus && view_->viewport()->isAncestorOf(focus)) view_->setFocus();
}

void MeasurementSheet::setMeasurements(const std::vector<MeasurementRecord>& measurements) {
  model_.setMeasurements(measurements);
}

void MeasurementSheet::setWaiting(bool waiting) {
  waiting_ = waiting;
  refresh();
}

void MeasurementSheet::submissionFailed(const QString& message) {
  saysEdit_ = false;
  model_.submissionFailed();
  banner_->showMessage(MessageBanner::Kind::error, message);
}

QString MeasurementSheet::progressText() const {
  const int rows = model_.rowCount(), voids = model_.voidCount();
  if (rows == 0) return tr("Nothing to measure");
  QString text = tr("%1 of %2 measured").arg(model_.doneCount() - voids).arg(rows);
  if (voids > 0) text += tr(", %1 void").arg(voids);
  if (const int entered = model_.enteredCount(); entered > 0)
    text += tr(" · %1 entered, not saved yet").arg(entered);
  else if (model_.hasUnsaved())
    text += tr(" · not saved yet");
  return text;
}

// An order only while the run waits for it.
QString MeasurementSheet::title() const {
  if (model_.rows().empty())
    return tr("<b>Nothing to measure now.</b> The run stops here by itself when real fitness is wanted.");
  const MeasurementTask& task = model_.rows().front().task;
  const QString times = task.wantedRepeats == 1 ? tr("once") : tr("%1 times").arg(task.wantedRepeats);
  const QString where = task.iteration > 0 ? tr("Stage %1, L2, iteration %2").arg(task.stage).arg(task.iteration)
                                           : tr("Stage %1").arg(task.stage);
  const QString what = (task.iteration > 0 ? tr("%1 policies") : tr("%1 individuals")).arg(model_.rows().size());
  if (waiting_ && isNewest() && !model_.isComplete())
    return tr("<b>%1: measure these %2</b> in the order given, %3 each.").arg(where, what, times);
  return tr("<b>%1: %2</b>, measured %3 each. A stored value is corrected by voiding it (right click) and entering "
            "another repeat.")
      .arg(where, what, times);
}

void MeasurementSheet::refresh() {
  QString title = this->title();
  if (standIn_)
    title += QString(" <span style=\"color:%1\">").arg(tonesOf(palette()).standIn.name()) +
             tr("The stand-in reality answers this run.") + "</span>";
  title_->setText(title);
  if (saysRefused_ && !model_.firstInvalid().isValid()) {
    saysRefused_ = false;
    banner_->clear();
  }
  progress_->setRange(0, std::max(1, model_.rowCount()));
  progress_->setValue(model_.doneCount());
  progressText_->setText(progressText());
  undo_->setEnabled(model_.undoStack().canUndo());
  redo_->setEnabled(model_.undoStack().canRedo());
  save_->setEnabled(model_.hasUnsaved());
  showSimulated_->setEnabled(!model_.isComplete());

  const bool ready = waiting_ && isNewest() && model_.isComplete() && !model_.hasUnsaved();
  continue_->setEnabled(ready);
  continue_->setDefault(ready);
  continue_->setToolTip(ready                 ? tr("The simulator adapts to what was measured, then learning goes on")
                        : !waiting_           ? tr("The run does not wait for measurements now")
                        : !isNewest()         ? tr("The run waits for the newest stage")
                        : model_.hasUnsaved() ? tr("Save the measurements first")
                                              : tr("Measure every individual first, or mark it void"));
}

// A message about an edit, or a question, ends with the next edit, undo or redo.
void MeasurementSheet::editsChanged() {
  question_->withdraw();
  clearSaidOfEdit();
  refresh();
}

void MeasurementSheet::clearSaidOfEdit() {
  if (saysEdit_) banner_->clear();
  saysEdit_ = false;
}

void MeasurementSheet::save() {
  finishEditing();
  if (const QModelIndex bad = model_.firstInvalid(); bad.isValid()) {
    view_->setCurrentIndex(bad);
    saysRefused_ = true;
    banner_->showMessage(MessageBanner::Kind::error,
                         tr("Individual %1: %2")
                             .arg(bad.siblingAtColumn(MeasurementModel::individualColumn).data().toString(),
                                  model_.problem(bad.row(), bad.column())));
    return;
  }
  if (!askBeforeSaving()) store();
}

bool MeasurementSheet::completesStage() const {
  const auto& rows = model_.rows();
  return std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.isDone() || row.isEntered(); });
}

// True if a person has to answer first.
bool MeasurementSheet::askBeforeSaving() {
  const std::vector<MeasurementModel::DoubtfulCell> doubtful = model_.doubtful();
  const bool isLast =
      goesOnByItself_ && waiting_ && isNewest() && model_.hasUnsaved() && !model_.isComplete() && completesStage();
  if (doubtful.empty() && !isLast) return false;
  QStringList lines;
  for (const auto& [cell, sentence] : doubtful)
    lines << tr("Individual %1: %2")
                 .arg(cell.siblingAtColumn(MeasurementModel::individualColumn).data().toString(), sentence);
  if (isLast)
    lines << tr("These are the last values of this stage: once they are saved, the run goes on with them by itself.");
  asked_ = doubtful.empty() ? QModelIndex() : doubtful.front().cell;
  question_->ask(lines.join('\n'), doubtful.empty() ? tr("Save and go on") : tr("They are right, save them"),
                 tr("Look again"));
  return true;
}

void MeasurementSheet::store() {
  const std::vector<MeasurementRecord> toVoid = model_.toVoid();
  if (!toVoid.empty() && !confirmVoid(toVoid)) return;
  std::map<Id, QString> notes;
  for (const MeasurementRow& row : model_.rows()) notes[row.task.individual] = row.edit.note;
  const std::vector<MeasurementRecord> records = model_.submit(who());
  for (const MeasurementRecord& value : toVoid) {
    const QString note = notes[value.individual];
    emit voidRequested(value.id, true, note.isEmpty() ? QString::fromStdString(value.note) : note);
  }
  if (records.empty() && toVoid.empty()) {
    if (model_.hasUnsaved()) {
      saysEdit_ = true;
      banner_->showMessage(MessageBanner::Kind::warning,
                           tr("A note is stored together with a value or void: enter one beside it"));
    }
    return;
  }
  banner_->clear();
  if (!records.empty()) emit submitted(records);
  if (!model_.isComplete()) view_->goToNextOpen();
}

void MeasurementSheet::sayLeftOut(const QStringList& texts) {
  saysEdit_ = true;
  banner_->showMessage(MessageBanner::Kind::warning,
                       tr("Not pasted, as there is no free cell for it: %1")
                           .arg(texts.mid(0, 5).join(QStringLiteral("; ")) + (texts.size() > 5 ? "; …" : "")));
}

void MeasurementSheet::sayUnclear(const QStringList& texts) {
  saysEdit_ = true;
  banner_->showMessage(MessageBanner::Kind::warning,
                       tr("Not pasted, as the other numbers' decimal mark makes it thousands, or it is none: %1")
                           .arg(texts.mid(0, 5).join(QStringLiteral("; ")) + (texts.size() > 5 ? "; …" : "")));
}

bool MeasurementSheet::confirmVoid(const std::vector<MeasurementRecord>& values) {
  QStringList said;
  for (const MeasurementRecord& value : values)
    said << tr("individual %1: %2").arg(value.individual).arg(exactText(value.value));
  QMessageBox box(QMessageBox::Question, tr("Void stored values"),
                  tr("Rows that are ticked as void hold stored values that count. Void these too?"),
                  QMessageBox::Cancel, this);
  box.setInformativeText(said.join('\n') + "\n\n" + tr("They stay stored, but count in no mean."));
  auto* yes = box.addButton(tr("Void them"), QMessageBox::AcceptRole);
  yes->setObjectName("voidStored");
  box.exec();
  return box.clickedButton() == yes;
}

void MeasurementSheet::askVoid(const QModelIndex& cell) {
  const MeasurementRecord* saved = model_.savedAt(cell);
  if (!saved) return;
  const Id id = saved->id;
  const bool toVoid = !saved->isVoid;
  bool ok = false;
  const QString note = QInputDialog::getText(this, toVoid ? tr("Void this value") : tr("Count this value again"),
                                             tr("The value %1 stays stored. Why?").arg(cell.data().toString()),
                                             QLineEdit::Normal, QString::fromStdString(saved->note), &ok);
  if (ok) emit voidRequested(id, toVoid, note.trimmed());
}

}  // namespace btr::ui
