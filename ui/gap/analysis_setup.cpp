#include "ui/gap/analysis_setup.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QSplitter>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>

#include "core/gap/recordings/doctor/objection.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/sim/scene.h"
#include "core/spec/error.h"
#include "ui/common/look/theme.h"
#include "ui/common/look/wrapped_label.h"
#include "ui/common/progress.h"
#include "ui/common/resources.h"
#include "ui/common/wheel_guard.h"
#include "ui/gap/mapping_form.h"
#include "ui/gap/recording_plot.h"
#include "ui/window/scroll_page.h"

namespace btr::ui {
namespace {

enum Column { file, heldOut, mapped };

/// Channels that a recording of this scene may have.
QStringList channelsOf(const SceneSpec& scene, const ModelSet& models) {
  QStringList names{"time_s"};
  for (const RobotSpec& robot : scene.robots) {
    const QString owner = QString::fromStdString(robot.name) + '.';
    const auto model = models.find(robot.model);
    if (model == models.end()) continue;
    for (const Joint& joint : model->second->joints) {
      if (joint.type == Joint::Type::fixed) continue;
      const QString of = owner + QString::fromStdString(joint.name) + '.';
      const bool slide = joint.type == Joint::Type::slide;
      for (const char* quantity : {"position", "command"}) names << of + quantity + (slide ? "_m" : "_rad");
      names << of + (slide ? "velocity_m_s" : "velocity_rad_s") << of + (slide ? "force_n" : "torque_nm")
            << of + "voltage_v" << of + "current_a" << of + "duty" << of + "enabled";
    }
    if (robot.base != "fixed")
      for (const char* quantity : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}) names << owner + "base." + quantity;
  }
  for (const BallSpec& ball : scene.balls)
    for (const char* quantity : {"x_m", "y_m", "z_m"}) names << QString::fromStdString(ball.name) + '.' + quantity;
  return names;
}

QWidget* withButton(QLineEdit* edit, QPushButton* button) {
  auto* both = new QWidget(edit->parentWidget());
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(edit, 1);
  row->addWidget(button);
  both->setFocusProxy(edit);
  return both;
}

}  // namespace

AnalysisSetup::AnalysisSetup(QWidget* parent) : QWidget(parent), mapping_(new MappingForm(this)) {
  WheelGuard::ensure();
  auto* splitter = new QSplitter(Qt::Vertical, this);
  splitter->addWidget(makeInputs());
  looks_ = new RecordingPlot(this);
  auto* below = new QTabWidget(this);
  below->setDocumentMode(true);
  below->addTab(mapping_, tr("Mappin&g"));
  below->addTab(looks_, tr("Look at &it"));
  below->setTabToolTip(1, tr("The recording as its mapping reads it"));
  splitter->addWidget(below);
  splitter->setChildrenCollapsible(false);
  splitter->setStretchFactor(0, 1);
  splitter->setStretchFactor(1, 1);
  problem_ = new QLabel(this);
  problem_->setWordWrap(true);
  problem_->setObjectName("setupProblem");
  progress_ = new QProgressBar(this);
  progress_->setTextVisible(true);
  progress_->setAccessibleName(tr("Progress of the analysis"));
  start_ = new QPushButton(themeIcon("media-playback-start"), tr("Start the &analysis"), this);
  start_->setObjectName("startAnalysis");
  cancel_ = new QPushButton(themeIcon("media-playback-stop"), tr("&Cancel"), this);
  cancel_->setObjectName("cancelAnalysis");
  connect(start_, &QPushButton::clicked, this, &AnalysisSetup::startRequested);
  connect(cancel_, &QPushButton::clicked, this, &AnalysisSetup::cancelRequested);
  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(8, 4, 8, 8);
  bar->addWidget(problem_, 1);
  bar->addWidget(progress_, 1);
  bar->addWidget(cancel_);
  bar->addWidget(start_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  // The bar stays in sight, however low the window is.
  layout->addWidget(new ScrollPage(splitter, this), 1);
  layout->addLayout(bar);
  connect(&tick_, &QTimer::timeout, this, [this] { showProgress(stageNow_, shareNow_); });
  connect(mapping_, &MappingForm::failed, this, &AnalysisSetup::failed);
  connect(mapping_, &MappingForm::saved, this, [this] {
    refresh();
    looks_->setRecording(mapping_->recording(), mappingOf(mapping_->recording()), scene());
  });
  setRunning(false);
}

QWidget* AnalysisSetup::makeInputs() {
  auto* inputs = new QWidget(this);
  scene_ = new QLineEdit(inputs);
  scene_->setObjectName("scene");
  scene_->setPlaceholderText(tr("The simulated world: SCENE.json with the numbers that may be calibrated"));
  out_ = new QLineEdit(inputs);
  out_->setObjectName("out");
  out_->setPlaceholderText(tr("Folder for the report"));
  seed_ = new QLineEdit("1", inputs);
  seed_->setObjectName("seed");
  seed_->setToolTip(tr("Same seed, same report"));
  simulator_ = new QComboBox(inputs);
  simulator_->setObjectName("simulator");
  simulator_->setToolTip(tr("The simulator that is compared with the recordings"));
  setSimulators({}, {});
  recordings_ = new QTableWidget(0, 3, inputs);
  recordings_->setObjectName("recordings");
  recordings_->setAccessibleName(tr("Recordings"));
  recordings_->setHorizontalHeaderLabels({tr("Recording"), tr("Held out"), tr("Mapping")});
  recordings_->horizontalHeaderItem(heldOut)->setToolTip(tr("Never used in a fit: scores the result at the end"));
  recordings_->verticalHeader()->hide();
  recordings_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  recordings_->horizontalHeader()->setSectionResizeMode(file, QHeaderView::Stretch);
  recordings_->horizontalHeader()->setSectionResizeMode(mapped, QHeaderView::ResizeToContents);
  recordings_->setSelectionBehavior(QAbstractItemView::SelectRows);
  recordings_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  recordings_->setShowGrid(false);
  recordings_->setAlternatingRowColors(true);

  const auto button = [&](const char* icon, const QString& text, auto slot) {
    auto* made = new QPushButton(themeIcon(icon), text, inputs);
    connect(made, &QPushButton::clicked, this, slot);
    return made;
  };
  auto* addButton = button("list-add", tr("Add rec&ordings…"), [this] { chooseRecordings(); });
  auto* removeButton = button("list-remove", tr("Re&move"), [this] { removeRecording(); });
  auto* storedButton = button("server-database", tr("From the data&base…"), [this] { emit storedRequested(); });
  storedButton->setToolTip(tr("Recordings that are kept with the selected run's experiment"));
  auto* keepButton = button("document-save", tr("&Keep in the database"),
                            [this] { emit keepRequested(files(false) + files(true), scene()); });
  keepButton->setToolTip(tr("Stores the files with their mappings and SHA-256; the same file is kept once"));
  auto* form = new QFormLayout(inputs);
  form->setContentsMargins(8, 8, 8, 4);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->addRow(tr("&Scene"), withButton(scene_, button("document-open", tr("Open…"), [this] { chooseScene(); })));
  auto* buttons = new QVBoxLayout;
  buttons->addWidget(addButton);
  buttons->addWidget(removeButton);
  buttons->addWidget(storedButton);
  buttons->addWidget(keepButton);
  buttons->addStretch(1);
  auto* row = new QHBoxLayout;
  row->addWidget(recordings_, 1);
  row->addLayout(buttons);
  form->addRow(tr("Recordings"), row);
  example_ = button("games-hint", tr("Try it &with a simulated XL330 servo"), [this] { fillWithExample(); });
  example_->setObjectName("tryExample");
  example_->setToolTip(
      tr("Three recordings that the simulator made itself, with dry friction that the scene does not have: an analysis "
         "finds it in about a minute"));
  form->addRow(example_);
  doctorSays_ = new WrappedLabel(inputs);
  doctorSays_->setObjectName("doctorSays");
  doctorSays_->setTextFormat(Qt::PlainText);
  doctorSays_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  doctorSays_->setAccessibleName(tr("What is odd about the recordings"));
  asRecorded_ = new QCheckBox(tr("Analyse as recorded, whatever the col&umns look like"), inputs);
  asRecorded_->setObjectName("asRecorded");
  connect(asRecorded_, &QCheckBox::toggled, this, [this] { refresh(); });
  form->addRow(doctorSays_);
  form->addRow(asRecorded_);
  form->addRow(tr("Simu&lator"), simulator_);
  form->addRow(tr("Re&port in"), withButton(out_, button("folder-new", tr("Choose…"), [this] {
                                              const QString chosen = QFileDialog::getExistingDirectory(
                                                  this, tr("Folder for the report"), out_->text());
                                              if (!chosen.isEmpty()) out_->setText(chosen);
                                            })));
  form->addRow(tr("See&d"), seed_);
  constexpr int longest_min = 24 * 60;
  within_ = new QSpinBox(inputs);
  within_->setObjectName("within");
  within_->setRange(0, longest_min);
  within_->setSuffix(tr(" min"));
  within_->setSpecialValueText(tr("none"));
  within_->setToolTip(tr("After this time nothing more is looked for; the report has what was found until then"));
  form->addRow(tr("Ma&x. time"), within_);
  connect(scene_, &QLineEdit::editingFinished, this, &AnalysisSetup::readScene);
  for (QLineEdit* edit : {scene_, out_, seed_}) connect(edit, &QLineEdit::textChanged, this, [this] { refresh(); });
  connect(recordings_, &QTableWidget::currentCellChanged, this, [this](int now, int, int before, int) {
    if (now != before) openMapping();
  });
  return inputs;
}

void AnalysisSetup::setScene(const QString& path) {
  scene_->setText(path);
  readScene();
}

QString AnalysisSetup::scene() const { return scene_->text().trimmed(); }

void AnalysisSetup::chooseScene() {
  const QString start = scene().isEmpty() ? resourceDirectory() + "/scenes" : scene();
  const QString chosen = QFileDialog::getOpenFileName(this, tr("Scene"), start, tr("Scenes (*.json);;All files (*)"));
  if (!chosen.isEmpty()) setScene(chosen);
}

// The form offers the scene's own channels; a scene that cannot be read is said at once.
void AnalysisSetup::readScene() {
  if (scene().isEmpty()) return;
  try {
    SceneSpec spec = loadScene(scene().toStdString());
    ModelSet models = loadModels(spec);
    spec_ = std::move(spec);
    models_ = std::move(models);
    sceneRead_ = scene();
    mapping_->setChannels(channelsOf(spec_, models_));
    if (!sceneProblem_.isEmpty()) emit mended(std::exchange(sceneProblem_, {}));
    openMapping();  // that of the scene, where there is one
    emit sceneChanged(scene());
  } catch (const std::exception& error) {
    sceneProblem_ = QString::fromUtf8(error.what());
    emit failed(sceneProblem_);
  }
  refresh();
}

void AnalysisSetup::chooseRecordings() {
  addRecordings(QFileDialog::getOpenFileNames(this, tr("Recordings"), QFileInfo(scene()).path(),
                                              tr("Recordings (*.csv);;All files (*)")));
}

void AnalysisSetup::addRecordings(const QStringList& paths) {
  const int before = recordings_->rowCount();
  for (const QString& path : paths) {
    if (recordingsHave(path)) continue;
    const int row = recordings_->rowCount();
    recordings_->insertRow(row);
    auto* name = new QTableWidgetItem(QFileInfo(path).fileName());
    name->setData(Qt::UserRole, path);
    name->setToolTip(path);
    recordings_->setItem(row, file, name);
    auto* check = new QTableWidgetItem;
    check->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    check->setCheckState(Qt::Unchecked);
    recordings_->setItem(row, heldOut, check);
    recordings_->setItem(row, mapped, new QTableWidgetItem);
  }
  // What was added is looked at: a file that is no recording is said at once.
  if (recordings_->rowCount() > before) recordings_->setCurrentCell(before, file);
  nameReport();
  refresh();
}

/// After the first recording, as long as nobody named the folder otherwise.
void AnalysisSetup::nameReport() {
  if (recordings_->rowCount() == 0 || (!out_->text().isEmpty() && out_->text() != named_)) return;
  const QString first = recordings_->item(0, file)->data(Qt::UserRole).toString();
  named_ = QDir(reportBase_).filePath(QFileInfo(first).completeBaseName() + "-gap-report");
  out_->setText(named_);
}

bool AnalysisSetup::keepEarlierReport() {
  static const QRegularExpression number(QStringLiteral("-\\d+$"));
  const auto isTaken = [](const QString& folder) { return QFileInfo::exists(QDir(folder).filePath("report.json")); };
  const QString asked = out_->text().trimmed();
  if (!isTaken(asked)) return false;
  QString base = asked, free;
  base.remove(number);
  for (int n = 2; free.isEmpty() || isTaken(free); ++n) free = base + "-" + QString::number(n);
  if (asked == named_) named_ = free;
  out_->setText(free);
  return true;
}

void AnalysisSetup::fillWithExample() {
  const QDir resources(resourceDirectory());
  const QDir made(resources.filePath("recordings/xl330-made"));
  setScene(QDir::cleanPath(resources.filePath("scenes/xl330.json")));
  addRecordings({QDir::cleanPath(made.filePath("made_kp200_sines.csv")),
                 QDir::cleanPath(made.filePath("made_kp400_slow.csv")),
                 QDir::cleanPath(made.filePath("made_kp200_chirp.csv"))});
  for (int row = 0; row < recordings_->rowCount(); ++row)
    setHeldOut(row, recordings_->item(row, file)->text() == "made_kp200_chirp.csv");
}

void AnalysisSetup::removeRecording() {
  if (recordings_->currentRow() >= 0) recordings_->removeRow(recordings_->currentRow());
  nameReport();
  refresh();
}

void AnalysisSetup::setHeldOut(int row, bool on) {
  recordings_->item(row, heldOut)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
  refresh();
}

void AnalysisSetup::setSimulators(const QStringList& names, const QStringList& texts) {
  // Called again and again while a run works: an open list is left alone.
  bool same = simulator_->count() == int(names.size()) + 1;
  for (int i = 1; same && i < simulator_->count(); ++i)
    same = simulator_->itemText(i) == names[i - 1] && simulator_->itemData(i).toString() == texts[i - 1];
  if (same) return;
  const QString before = simulator_->currentText();
  simulator_->clear();
  simulator_->addItem(tr("the scene as given"), QString());
  for (qsizetype i = 0; i < std::min(names.size(), texts.size()); ++i) simulator_->addItem(names[i], texts[i]);
  simulator_->setCurrentIndex(std::max(0, simulator_->findText(before)));
}

QString AnalysisSetup::simulatorText() const { return simulator_->currentData().toString(); }

QStringList AnalysisSetup::files(bool held) const {
  QStringList all;
  for (int row = 0; row < recordings_->rowCount(); ++row)
    if ((recordings_->item(row, heldOut)->checkState() == Qt::Checked) == held)
      all << recordings_->item(row, file)->data(Qt::UserRole).toString();
  return all;
}

QString AnalysisSetup::seenHeldOut() const {
  for (const QString& held : files(true))
    for (const QString& fitted : files(false))
      if (QFileInfo(held).size() == QFileInfo(fitted).size() && digests_.of(held) == digests_.of(fitted)) return held;
  return {};
}

AnalysisJob AnalysisSetup::job() const {
  AnalysisJob job;
  job.scene = scene();
  job.recordings = files(false);
  job.heldOut = files(true);
  job.out = out_->text().trimmed();
  job.seed = seed_->text().trimmed().toULongLong();
  job.within_min = within_->value();
  job.asRecorded = certain_ && asRecorded_->isChecked();
  return job;
}

QString AnalysisSetup::problem() const {
  bool isSeed = false;
  seed_->text().trimmed().toULongLong(&isSeed);
  if (scene().isEmpty()) return tr("Choose the scene.");
  if (!QFileInfo(scene()).isFile()) return tr("There is no scene %1.").arg(scene());
  if (files(false).isEmpty()) return tr("Add at least one recording that is not held out.");
  if (const QString seen = seenHeldOut(); !seen.isEmpty())
    return tr("%1 is held out, but the same file is fitted.").arg(QFileInfo(seen).fileName());
  if (out_->text().trimmed().isEmpty()) return tr("Choose the report's folder.");
  if (!isSeed) return tr("Seed: %1 is not allowed; a whole number from 0").arg(seed_->text());
  if (recordingsHave(mapping_->recording()) && mapping_->isChanged()) {
    const QString of = QFileInfo(mapping_->recording()).fileName();
    return mapping_->isEdited() ? tr("The mapping of %1 has changes that are not saved.").arg(of)
                                : tr("The mapping of %1 is a guess: look at it and save it.").arg(of);
  }
  if (certain_ && !asRecorded_->isChecked())
    return tr("A column is certainly not what its name says: mend the mapping, or analyse as recorded.");
  return {};
}

QString AnalysisSetup::mappingOf(const QString& recording) const {
  return QString::fromStdString(findMapping(recording.toStdString(), scene().toStdString()).value_or(""));
}

bool AnalysisSetup::recordingsHave(const QString& path) const {
  return files(true).contains(path) || files(false).contains(path);
}

void AnalysisSetup::openMapping() {
  const int row = recordings_->currentRow();
  if (row < 0 || !recordings_->item(row, file)) return;
  const QString path = recordings_->item(row, file)->data(Qt::UserRole).toString();
  const QString found = mappingOf(path);
  looks_->setRecording(path, found, scene());
  if (mapping_->recording() == path && (found.isEmpty() || found == mapping_->file())) return;
  // What was typed is kept; a guess is not.
  if (mapping_->isEdited() && recordingsHave(mapping_->recording())) {
    if (mapping_->recording() != path)
      emit failed(tr("The mapping of %1 has changes that are not saved: save or undo them before you look at another.")
                      .arg(QFileInfo(mapping_->recording()).fileName()));
    return;
  }
  try {
    mapping_->open(path, found);
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
}

// Said again each second: some stages last without a word.
void AnalysisSetup::showProgress(const QString& stage, double share) {
  stageNow_ = stage;
  shareNow_ = share;
  ui::showProgress(*progress_, stage, share, begun_.isValid() ? double(begun_.elapsed()) / 1000 : -1);
}

void AnalysisSetup::setRunning(bool running) {
  running_ = running;
  progress_->setVisible(running);
  cancel_->setEnabled(running);
  cancel_->setVisible(running);
  if (running) {
    begun_.start();
    tick_.start(1000);
    showProgress(tr("starting"), 0);
  } else {
    tick_.stop();
  }
  refresh();
}

// Before physics is blamed: what the columns themselves say, by recording; the same words stand once.
void AnalysisSetup::askDoctor() {
  constexpr qsizetype mostLines = 6;
  QStringList lines, notes, said;
  Objection objection;
  for (int row = 0; row < recordings_->rowCount() && !spec_.robots.empty(); ++row) {
    const QString path = recordings_->item(row, file)->data(Qt::UserRole).toString();
    const QString mapping = mappingOf(path);
    const RecordingDoctor::Opinion& opinion = doctor_.of(path, mapping, sceneRead_, spec_, models_);
    for (const Diagnosis& trial : opinion.trials) objection.hear(path.toStdString(), mapping.toStdString(), trial);
    recordings_->item(row, file)->setToolTip((QStringList{path} + opinion.findings + opinion.notes).join('\n'));
    const auto tell = [&](const QStringList& texts, QStringList& to) {
      for (QString text : texts) {
        if (text.startsWith(path)) text = text.mid(path.size() + (text.mid(path.size(), 1) == ":")).trimmed();
        if (said.contains(text)) continue;
        said << text;
        to << QFileInfo(path).fileName() + ": " + text;
      }
    };
    tell(opinion.findings, lines);
    tell(opinion.notes, notes);
  }
  lines += notes;  // of all recordings first what may be wrong
  certain_ = objection.text().has_value();
  if (lines.size() > mostLines) {
    const qsizetype more = lines.size() - mostLines;
    lines = lines.mid(0, mostLines) << tr("and %1 more, see the recordings' tips").arg(more);
  }
  doctorSays_->setText(lines.join('\n'));
  doctorSays_->setVisible(!lines.isEmpty());
  asRecorded_->setVisible(certain_);
}

void AnalysisSetup::refresh() {
  for (int row = 0; row < recordings_->rowCount(); ++row) {
    const QString path = recordings_->item(row, file)->data(Qt::UserRole).toString();
    const QString found = mappingOf(path);
    recordings_->item(row, mapped)->setText(found.isEmpty() ? tr("none") : QFileInfo(found).fileName());
    recordings_->item(row, mapped)->setToolTip(found);
  }
  example_->setVisible(recordings_->rowCount() == 0);
  askDoctor();
  const QString missing = problem();
  problem_->setText(missing);
  problem_->setVisible(!running_);
  start_->setEnabled(!running_ && missing.isEmpty());
  emit changed();
}

}  // namespace btr::ui
