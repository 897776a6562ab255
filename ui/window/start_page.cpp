#include "ui/window/start_page.h"

#include <QCheckBox>
#include <QEvent>
#include <QFileInfo>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/common/look/plain_tip.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/resources.h"
#include "ui/experiment/run_text.h"

namespace btr::ui {
namespace {

constexpr std::size_t runsOffered = 5;
constexpr int pictureSize = 32;

QPushButton* button(const QString& name, const QString& icon, const QString& text, QWidget* parent) {
  auto* made = new QPushButton(themeIcon(icon), text, parent);
  made->setObjectName(name);
  return made;
}

}  // namespace

StartPage::StartPage(QWidget* parent) : QWidget(parent) {
  auto* title = new QLabel(tr("What would you like to do?"), this);
  QFont large = title->font();
  large.setPointSizeF(large.pointSizeF() * 1.6);
  large.setBold(true);
  title->setFont(large);
  auto* doors = new QHBoxLayout;
  doors->setSpacing(14);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 20, 24, 16);
  column->setSpacing(14);
  column->addWidget(title);
  column->addLayout(doors);
  column->addStretch();

  auto* look = addDoor("lookDoor", "office-chart-line", tr("Look at a finished experiment"),
                       tr("Its fitness over the generations, what was measured, the gap between simulation and "
                          "reality, and each individual in 3D."));
  finished_ = new QVBoxLayout;
  look->addLayout(finished_);
  auto* other = button("openDatabase", "folder-open", tr("Open another database…"), this);
  look->addWidget(other);
  look->addStretch();
  connect(other, &QPushButton::clicked, this, [this] { emit databaseWanted({}); });

  auto* setUp = addDoor("setUpDoor", "document-new", tr("Set up an experiment"),
                        tr("Choose robot, task and learner; learn in simulation, measure the best on the real robot, "
                           "adapt the simulator and learn on."));
  auto* fresh = button("newExperiment", "document-new", tr("New experiment"), this);
  auto* example = button("example", "folder-templates", tr("Begin with an example"), this);
  auto* examples = new QMenu(example);
  for (const QString& path : exampleExperiments())
    examples->addAction(inMenu(exampleName(path)), this, [this, path] { emit exampleWanted(path); });
  example->setMenu(examples);
  example->setEnabled(!examples->isEmpty());
  setUp->addWidget(fresh);
  setUp->addWidget(example);
  setUp->addStretch();
  connect(fresh, &QPushButton::clicked, this, &StartPage::newWanted);

  auto* analyse = addDoor("analyseDoor", "office-chart-area", tr("Analyse recordings"),
                          tr("Give a scene and recordings of the real robot: the analysis calibrates the simulator and "
                             "names the physics that it lacks."));
  auto* gap = button("analyse", "office-chart-area", tr("Gap analysis"), this);
  auto* report = button("openReport", "document-open", tr("Open a report…"), this);
  analyse->addWidget(gap);
  analyse->addWidget(report);
  analyse->addStretch();
  connect(gap, &QPushButton::clicked, this, &StartPage::analysisWanted);
  connect(report, &QPushButton::clicked, this, &StartPage::reportWanted);
  for (auto* door : findChildren<QFrame*>(QRegularExpression("Door$"))) doors->addWidget(door, 1);

  atStart_ = new QCheckBox(tr("Show this page at the start when no run waits to be continued"), this);
  atStart_->setObjectName("atStart");
  atStart_->setChecked(true);
  column->addWidget(atStart_);
  connect(atStart_, &QCheckBox::toggled, this, &StartPage::shownAtStartChanged);
  setRuns({}, {});
}

QVBoxLayout* StartPage::addDoor(const QString& name, const QString& icon, const QString& title, const QString& text) {
  auto* door = new QFrame(this);
  door->setObjectName(name);
  door->setFrameShape(QFrame::StyledPanel);
  auto* column = new QVBoxLayout(door);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(8);
  auto* picture = new QLabel(door);
  picture->setObjectName("picture");
  picture->setPixmap(themeIcon(icon).pixmap(pictureSize, pictureSize));
  pictures_[picture] = icon;
  auto* caption = new QLabel(title, door);
  QFont bold = caption->font();
  bold.setPointSizeF(bold.pointSizeF() * 1.2);
  bold.setBold(true);
  caption->setFont(bold);
  auto* words = new QLabel(text, door);
  for (QLabel* label : {caption, words}) label->setWordWrap(true);
  column->addWidget(picture);
  column->addWidget(caption);
  column->addWidget(words);
  return column;
}

void StartPage::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange)
    for (const auto& [picture, icon] : pictures_) picture->setPixmap(themeIcon(icon).pixmap(pictureSize, pictureSize));
  QWidget::changeEvent(event);
}

bool StartPage::isSomethingOpen(const std::vector<RunRecord>& runs) {
  return std::ranges::any_of(
      runs, [](const RunRecord& run) { return run.state != RunState::finished && run.state != RunState::failed; });
}

void StartPage::setShownAtStart(bool shown) {
  const QSignalBlocker quiet(atStart_);
  atStart_->setChecked(shown);
}

void StartPage::setRuns(const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
  std::vector<const RunRecord*> newest;
  for (auto run = runs.rbegin(); run != runs.rend() && newest.size() < runsOffered; ++run)
    if (run->state == RunState::finished) newest.push_back(&*run);
  std::vector<Id> ids;
  for (const RunRecord* run : newest) ids.push_back(run->id);
  if (ids == offered_ && finished_->count() > 0) return;
  offered_ = ids;
  while (QLayoutItem* old = finished_->takeAt(0)) {
    if (old->widget()) old->widget()->deleteLater();
    delete old;
  }
  for (const RunRecord* run : newest) {
    QString name;
    for (const ExperimentRecord& experiment : experiments)
      if (experiment.id == run->experiment) name = QString::fromStdString(experiment.name);
    auto* entry = button(QStringLiteral("run%1").arg(run->id), "emblem-checked", runName(*run), this);
    entry->setToolTip(plainTip(name));
    auto* of = new QLabel(name, this);
    of->setTextFormat(Qt::PlainText);  // a name is a person's
    of->setWordWrap(true);
    finished_->addWidget(of);
    finished_->addWidget(entry);
    connect(entry, &QPushButton::clicked, this, [this, id = run->id] { emit runWanted(id); });
  }
  if (!newest.empty()) return;
  const QString shipped = exampleDatabase();
  if (shipped.isEmpty()) {
    finished_->addWidget(new QLabel(tr("This database has no finished run yet."), this));
    return;
  }
  auto* open = button("exampleDatabase", "folder-open", tr("Open the example database"), this);
  finished_->addWidget(open);
  connect(open, &QPushButton::clicked, this, [this, shipped] { emit databaseWanted(shipped); });
}

}  // namespace btr::ui
