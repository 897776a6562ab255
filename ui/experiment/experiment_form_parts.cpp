// The parts of the experiment form that are not made from declared parameters.
#include <QAction>
#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <utility>

#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "ui/common/edit_command.h"
#include "ui/common/file_choice.h"
#include "ui/common/form_undo.h"
#include "ui/common/look/combo_width.h"
#include "ui/common/look/tab_order.h"
#include "ui/common/look/theme.h"
#include "ui/common/resources.h"
#include "ui/common/undoable_line.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/learner_form.h"
#include "ui/experiment/parameter_form.h"

namespace btr::ui {

QLineEdit* ExperimentForm::addText(QVBoxLayout& column, const QString& name, const QString& label,
                                   const QString& toolTip, QWidget* beside) {
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 2, 8, 2);
  auto* caption = new QLabel(label, this);
  auto* edit = new QLineEdit(this);
  leaveUndoToForm(edit);
  caption->setBuddy(edit);
  caption->setMinimumWidth(fontMetrics().horizontalAdvance("Controller  "));
  edit->setObjectName(name);
  edit->setAccessibleName(label);
  edit->setToolTip(toolTip);
  row->addWidget(caption);
  row->addWidget(edit, 1);
  if (beside) row->addWidget(beside);
  column.addLayout(row);

  makeUndoable(*edit, undo_, tr("change %1").arg(label), [this] { update(); });
  return edit;
}

QWidget* ExperimentForm::makeGeneral() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  name_ = addText(*column, "name", tr("Name"), tr("How this experiment is called in the tree, in files and reports"));
  browse_ = new QPushButton(themeIcon("document-open"), {}, this);
  browse_->setToolTip(tr("Choose a scene file"));
  browse_->setAccessibleName(tr("Choose a scene file"));
  connect(browse_, &QPushButton::clicked, this, &ExperimentForm::browseScene);
  scene_ =
      addText(*column, "scene", tr("Scene"), tr("Scene file (*.json), relative to the experiment's own file"), browse_);
  seed_ = new ParameterForm(
      {{"seed", "", "same experiment and same seed give the same bits", 0, 9007199254740991, 1, {}, true}}, undo_,
      part);
  column->addWidget(seed_);
  return part;
}

QWidget* ExperimentForm::makeReality() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 2, 8, 2);
  auto* caption = new QLabel(tr("Measured by"), part);
  reality_ = new QComboBox(part);
  reality_->setObjectName("reality");
  reality_->setFocusPolicy(Qt::StrongFocus);
  letShrink(*reality_);
  reality_->addItem(tr("a person, on the real robot"), "person");
  reality_->addItem(tr("a stand-in reality (demonstration)"), "stand_in");
  offerRealities();
  caption->setBuddy(reality_);
  row->addWidget(caption);
  row->addWidget(reality_, 1);
  column->addLayout(row);
  realityForm_ = new RealityForm(offers_.realities, undo_, part);
  connect(realityForm_, &RealityForm::changed, this, &ExperimentForm::update);
  column->addWidget(realityForm_);
  standInNote_ = new QLabel(
      tr("Stand-in reality: a simulated robot with concealed parameters, for demonstration. It is no real robot; every "
         "result of this run is labelled so."),
      part);
  standInNote_->setObjectName("standInNote");
  standInNote_->setWordWrap(true);
  standInNote_->setContentsMargins(8, 2, 8, 2);
  column->addWidget(standInNote_);
  standIn_ = new ParameterForm(standInParameters(), undo_, part);
  standIn_->setObjectName("standIn");
  column->addWidget(standIn_);
  concealed_ = new QLabel(part);
  concealed_->setObjectName("concealed");
  concealed_->setWordWrap(true);
  concealed_->setContentsMargins(8, 2, 8, 2);
  column->addWidget(concealed_);

  // The combo box tells only what it became: what was chosen before is remembered here.
  connect(reality_, &QComboBox::activated, this, [this](int index) {
    if (index == chosenReality_) return;
    undo_.push(new EditCommand(tr("choose who measures"), {}, -1, chosenReality_, index, [this](const QVariant& value) {
      chosenReality_ = value.toInt();
      reality_->setCurrentIndex(chosenReality_);
      update();
    }));
  });
  return part;
}

QWidget* ExperimentForm::makeRealityLearning() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  auto* hint =
      new QLabel(tr("After a measurement a second learner may go on in reality from the best individual: it proposes "
                    "policies, these are measured, it takes a step. What it finds goes back into the simulator."),
                 part);
  hint->setWordWrap(true);
  hint->setContentsMargins(8, 2, 8, 2);
  column->addWidget(hint);
  column->addWidget(realityLearner_);
  column->addWidget(realitySettings_);
  return part;
}

void ExperimentForm::followController() {
  const PluginChoice choice = controller_->choice();
  const QString controller = QString::fromStdString(choice.name);
  genotype_ = genotypeFor(choice, shown_);
  for (auto* form : {learner_, realityLearner_, searchStart_}) form->setGenotype(genotype_);
  // Another controller brings pages that are made only now.
  if (std::exchange(followed_, controller) != controller) orderTabs(*inside_);
}

// What the experiment itself says stays seen, so that it can be mended.
void ExperimentForm::setMeaningful(const std::vector<Parameter>& parameters) {
  std::set<std::string> names(shown_.adapted.begin(), shown_.adapted.end());
  for (const Parameter& p : parameters) names.insert(p.name);
  for (const Parameter& p : simulatorParameters())
    if (valueOf(simulatorParameters(), shown_.simulator.values, p.name) != p.byDefault) names.insert(p.name);
  simulator_->setShown(names);
}

void ExperimentForm::followScene() {
  if (readOnly_) return;
  const QString path = QDir(QString::fromStdString(shown_.directory)).absoluteFilePath(scene_->text().trimmed());
  const QFileInfo file(path);
  if (!file.isFile()) return;
  const QString read = path + file.lastModified().toString(Qt::ISODateWithMs);
  if (std::exchange(sceneRead_, read) == read) return;
  try {
    setMeaningful(parametersOfScene(path.toStdString()));
  } catch (const InputError&) {
    // Whoever starts the run is told what is wrong with the scene; until then all are shown.
    setMeaningful(simulatorParameters());
  }
}

std::set<std::string> ExperimentForm::adapted() const {
  std::set<std::string> names = simulator_->checked();
  std::erase_if(names, [this](const std::string& name) { return !simulator_->shows(name); });
  return names;
}

QWidget* ExperimentForm::makeRecordings() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  auto* hint = new QLabel(tr("After one measurement stage the measured individuals are recorded as well; gap analysis "
                             "says what the simulator lacks, and learning goes on in the repaired simulator."),
                          part);
  recorded_ = new QLabel(part);
  recorded_->setObjectName("recorded");
  for (QLabel* label : {hint, recorded_}) {
    label->setWordWrap(true);
    label->setContentsMargins(8, 2, 8, 2);
  }
  recordings_ = new ParameterForm(recordingParameters(), undo_, part);
  recordings_->setObjectName("recordings");
  column->addWidget(hint);
  column->addWidget(recordings_);
  column->addWidget(recorded_);
  return part;
}

void ExperimentForm::makeBars(QVBoxLayout& column) {
  // Above: undo and redo, or why nothing can be changed here.
  editBar_ = new QWidget(this);
  auto* bar = new QHBoxLayout(editBar_);
  bar->setContentsMargins(6, 4, 6, 2);
  const auto button = [&](const QString& icon, const QString& text, const QKeySequence& keys) {
    auto* action = new QAction(themeIcon(icon), text, this);
    action->setShortcut(keys);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    addAction(action);
    auto* tool = new QToolButton(editBar_);
    tool->setDefaultAction(action);
    tool->setAutoRaise(true);
    bar->addWidget(tool);
    return action;
  };
  auto* undo = button("edit-undo", tr("Undo"), QKeySequence::Undo);
  auto* redo = button("edit-redo", tr("Redo"), QKeySequence::Redo);
  auto* reset = button("edit-clear-all", tr("Reset all to defaults"), {});
  undo->setEnabled(false);
  redo->setEnabled(false);
  connect(&undo_, &QUndoStack::canUndoChanged, undo, &QAction::setEnabled);
  connect(&undo_, &QUndoStack::canRedoChanged, redo, &QAction::setEnabled);
  connect(&undo_, &QUndoStack::undoTextChanged, undo,
          [undo](const QString& text) { undo->setToolTip(tr("Undo %1").arg(text)); });
  connect(undo, &QAction::triggered, &undo_, &QUndoStack::undo);
  connect(redo, &QAction::triggered, &undo_, &QUndoStack::redo);
  connect(reset, &QAction::triggered, this, &ExperimentForm::resetAll);
  bar->addStretch();
  auto* open = new QPushButton(themeIcon("document-open"), tr("Open…"), editBar_);
  open->setToolTip(tr("Open an experiment (*.json)"));
  bar->addWidget(open);
  connect(open, &QPushButton::clicked, this, &ExperimentForm::openRequested);
  column.insertWidget(0, editBar_);

  why_ = new QLabel(this);
  why_->setWordWrap(true);
  why_->setMargin(8);
  column.insertWidget(1, why_);

  // Below: what is wrong, and what can be done with the whole.
  problem_ = new QLabel(this);
  problem_->setObjectName("problem");
  problem_->setWordWrap(true);
  problem_->setMargin(6);
  column.addWidget(problem_);
  auto* buttons = new QHBoxLayout;
  buttons->setContentsMargins(8, 6, 8, 6);
  save_ = new QPushButton(themeIcon("document-save-as"), tr("Save as JSON…"), this);
  save_->setObjectName("save");
  start_ = new QPushButton(themeIcon("media-playback-start"), tr("Start run"), this);
  start_->setObjectName("start");
  start_->setDefault(true);
  start_->setToolTip(tr("Store this experiment and begin learning"));
  copy_ = new QPushButton(themeIcon("edit-copy"), tr("Use for a new experiment"), this);
  copy_->setObjectName("copy");
  buttons->addWidget(save_);
  buttons->addStretch();
  buttons->addWidget(copy_);
  buttons->addWidget(start_);
  column.addLayout(buttons);
  connect(save_, &QPushButton::clicked, this, &ExperimentForm::saveRequested);
  auto* saveKey = new QAction(this);
  saveKey->setShortcut(QKeySequence::Save);
  saveKey->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  connect(saveKey, &QAction::triggered, this, [this] {
    if (!readOnly_ && save_->isEnabled()) emit saveRequested();
  });
  addAction(saveKey);
  connect(start_, &QPushButton::clicked, this, &ExperimentForm::startRequested);
  connect(copy_, &QPushButton::clicked, this, &ExperimentForm::copyRequested);
}

void ExperimentForm::browseScene() {
  const QDir folder(QString::fromStdString(shown_.directory));
  const QFileInfo present(folder, scene_->text().trimmed());
  const QString scenes = resourceDirectory() + "/scenes";
  const QString start = present.isFile()            ? present.absolutePath()
                        : QFileInfo(scenes).isDir() ? scenes
                                                    : folder.absolutePath();
  if (const QString file = chooseFile(this, tr("Choose a scene"), start, FileKind::scene); !file.isEmpty())
    chooseScene(file);
}

void ExperimentForm::chooseScene(const QString& file) {
  const QDir folder(QString::fromStdString(shown_.directory));
  const QString path = shown_.directory.empty() ? file : folder.relativeFilePath(file);
  undo_.push(new EditCommand(tr("choose a scene"), {}, -1, scene_->text(), path, [this](const QVariant& value) {
    scene_->setText(value.toString());
    update();
  }));
}

void ExperimentForm::focusFirst() {
  name_->setFocus(Qt::OtherFocusReason);
  name_->selectAll();
}

}  // namespace btr::ui
