#include "ui/experiment/run_panel.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/common/look/short_label.h"
#include "ui/common/look/style_sheet.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {

RunPanel::RunPanel(QWidget* parent)
    : QWidget(parent),
      icon_(new QLabel(this)),
      stage_(new ShortLabel(this)),
      name_(new ShortLabel(this)),
      standIn_(new ShortLabel(this)),
      next_(new QLabel(this)),
      message_(new QLabel(this)),
      overall_(new QProgressBar(this)),
      within_(new QProgressBar(this)),
      go_(new QPushButton(themeIcon("media-playback-start"), tr("Start"), this)),
      stop_(new QPushButton(themeIcon("media-playback-stop"), tr("Stop"), this)),
      jobs_(new QSpinBox(this)) {
  standIn_->setTexts(
      tr("STAND-IN REALITY"), tr("STAND-IN"),
      tr("The measurements are answered by a simulated robot with concealed parameters, for demonstration. "
         "No real robot was measured."));
  stage_->setObjectName("stage");
  next_->setObjectName("next");
  message_->setObjectName("message");
  standIn_->setObjectName("standIn");
  overall_->setObjectName("overall");
  within_->setObjectName("within");
  go_->setObjectName("go");
  stop_->setObjectName("stop");
  jobs_->setObjectName("jobs");
  QFont large = stage_->font();
  large.setPointSizeF(large.pointSizeF() * 1.3);
  large.setBold(true);
  stage_->setFont(large);
  next_->setWordWrap(true);
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  jobs_->setRange(0, 1024);
  jobs_->setSpecialValueText(tr("all cores"));
  jobs_->setToolTip(tr("Worker processes for the next start; the result does not depend on it"));
  jobs_->setAccessibleName(tr("Worker processes"));

  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  head->addWidget(icon_);
  head->addWidget(stage_);
  head->addWidget(name_);
  head->addWidget(standIn_);
  head->addStretch();
  auto* jobsLabel = new QLabel(tr("Workers"), this);
  jobsLabel->setBuddy(jobs_);
  head->addWidget(jobsLabel);
  head->addWidget(jobs_);
  head->addWidget(go_);
  head->addWidget(stop_);

  auto* bars = new QHBoxLayout;
  bars->setSpacing(12);
  overall_->setAccessibleName(tr("Progress of the run"));
  within_->setAccessibleName(tr("Progress of the stage"));
  bars->addWidget(overall_, 3);
  bars->addWidget(within_, 2);

  auto* figures = new QHBoxLayout;
  figures->setSpacing(28);
  bestShown_ = addFigure(*figures, "best", tr("Best"), tr("Best fitness of all generations in the newest simulator"));
  mean_ = addFigure(*figures, "mean", tr("Mean"), tr("Mean fitness of the last generation"));
  speed_ = addFigure(*figures, "speed", tr("Speed"), tr("Simulated trials per second, all workers together"));
  trialsShown_ =
      addFigure(*figures, "trials", tr("Trials"), tr("Trials of L1 in all stored generations, over all starts"));
  left_ =
      addFigure(*figures, "left", tr("Time left"),
                tr("Estimate for all learning and adapting of the simulator that is to come; measuring not counted"));
  figures->addStretch();

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 8, 12, 8);
  column->setSpacing(6);
  column->addLayout(head);
  column->addWidget(next_);
  column->addLayout(bars);
  column->addLayout(figures);
  column->addWidget(message_);
  column->addStretch();
  connect(go_, &QPushButton::clicked, this, [this] { emit continueRequested(run_.id); });
  connect(stop_, &QPushButton::clicked, this, [this] { emit stopRequested(run_.id); });
  connect(jobs_, &QSpinBox::valueChanged, this, &RunPanel::jobsChanged);
  refresh();
}

RunPanel::Figure RunPanel::addFigure(QHBoxLayout& row, const QString& name, const QString& caption,
                                     const QString& toolTip) {
  auto* column = new QVBoxLayout;
  column->setSpacing(0);
  Figure figure{new QLabel(caption, this), new QLabel(this)};
  QFont small = figure.caption->font();
  small.setPointSizeF(small.pointSizeF() * 0.88);
  figure.caption->setFont(small);
  figure.caption->setForegroundRole(QPalette::PlaceholderText);
  QFont bold = figure.value->font();
  bold.setBold(true);
  figure.value->setFont(bold);
  figure.value->setObjectName(name);
  figure.value->setToolTip(toolTip);
  figure.caption->setToolTip(toolTip);
  column->addWidget(figure.caption);
  column->addWidget(figure.value);
  row.addLayout(column);
  return figure;
}

void RunPanel::showRun(const RunRecord& run, const RunProgress& progress, bool active) {
  if (run.id != run_.id) measuring_ = {};
  if (run.id != generation_.run) {
    generation_ = best_ = {};
    trials_ = 0;
  }
  run_ = run;
  progress_ = progress;
  active_ = active;
  empty_ = false;
  refresh();
}

void RunPanel::setGenerations(const std::vector<GenerationRecord>& all) {
  generation_ = best_ = {};
  trials_ = 0;
  addGenerations(all);
}

void RunPanel::addGenerations(const std::vector<GenerationRecord>& added) {
  for (const GenerationRecord& generation : added) {
    trials_ += generation.trials;
    // What another simulator gave is not to be compared.
    if (generation.simulator != best_.simulator || best_.number == 0 || generation.best > best_.best)
      best_ = generation;
    generation_ = generation;
  }
  generation_.individuals.clear();
  best_.individuals.clear();
  refresh();
}

void RunPanel::setMeasuring(const MeasuringCount& measuring) {
  measuring_ = measuring;
  refresh();
}

void RunPanel::setBlind(bool blind) {
  if (blind_ == blind) return;
  blind_ = blind;
  refresh();
}

void RunPanel::clear() {
  empty_ = true;
  run_ = {};
  refresh();
}

void RunPanel::setUnit(const QString& unit) {
  unit_ = unit;
  refresh();
}

void RunPanel::setJobs(int jobs) { jobs_->setValue(jobs); }
int RunPanel::jobs() const { return jobs_->value(); }

void RunPanel::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) refresh();
  QWidget::changeEvent(event);
}

// Everything that is seen follows from run, progress and activity.
void RunPanel::refresh() {
  const Tones tones = tonesOf(palette());
  if (empty_) {
    stage_->setTexts(tr("No run is selected"));
    next_->setText(tr("Choose a run in the tree, or describe a new experiment and start it."));
    icon_->clear();
    shownIcon_.clear();
    name_->setTexts({});
    message_->clear();
    for (QWidget* widget : std::initializer_list<QWidget*>{standIn_, message_, overall_, within_, go_, stop_})
      widget->setVisible(false);
    for (const Figure& figure : {bestShown_, mean_, speed_, trialsShown_, left_})
      figure.value->setText(QStringLiteral("–"));
    return;
  }
  face_ = faceOf(run_, active_);
  // An icon is drawn from its file each time.
  const QString icon = QString(iconName(face_)) + palette().windowText().color().name();
  if (std::exchange(shownIcon_, icon) != icon) icon_->setPixmap(themeIcon(iconName(face_)).pixmap(22, 22));
  stage_->setTexts(stageText(face_, progress_), briefStageText(face_, progress_));
  name_->setTexts(runName(run_), tr("Run %1").arg(run_.id));
  standIn_->setVisible(isStandIn(run_));
  styleOnce(*standIn_, QStringLiteral("color: %1; border: 1px solid %1; border-radius: 8px; padding: 1px 8px; "
                                      "font-weight: 600;")
                           .arg(tones.standIn.name()));
  next_->setText(nextAction(face_, run_, progress_, measuring_, active_));

  const int total = std::max(progress_.totalGenerations, run_.generation);
  overall_->setVisible(true);
  // The words come before the number: a bar paints itself at once when its number changes.
  overall_->setFormat(
      tr("generation %1 of %2").arg(run_.generation).arg(total > 0 ? QString::number(total) : QStringLiteral("?")));
  overall_->setRange(0, std::max(total, 1));
  overall_->setValue(run_.generation);
  // Until the first step of L3 is done, the progress is still that of the stage before.
  const bool adapting = face_ == RunFace::adapting || (active_ && progress_.stage == "L3");
  const bool isOld = adapting && (progress_.stage != "L3" || progress_.stageDone == 0);
  const bool counts = face_ == RunFace::waiting ? measuring_.wanted > 0 : active_ && progress_.stageTotal > 0 && !isOld;
  within_->setVisible(counts);
  if (counts && face_ == RunFace::waiting) {
    QString words = tr("measured %1 of %2").arg(measuring_.settled).arg(measuring_.wanted);
    if (adapting && !isOld) words += tr(" · L3 %1 of %2").arg(progress_.stageDone).arg(progress_.stageTotal);
    within_->setFormat(words);
    within_->setRange(0, measuring_.wanted);
    within_->setValue(measuring_.settled);
  } else if (counts) {
    within_->setFormat(tr("this stage %1 of %2").arg(progress_.stageDone).arg(progress_.stageTotal));
    within_->setRange(0, progress_.stageTotal);
    within_->setValue(progress_.stageDone);
  }

  bestShown_.caption->setText(adapting ? tr("Smallest error") : tr("Best"));
  mean_.caption->setText(adapting ? tr("Mean error") : tr("Mean"));
  const bool known = adapting ? !isOld : generation_.number > 0;
  const auto said = [&](double value) {
    if (blind_ && !adapting) return tr("hidden");
    return known ? withUnit(value, unit_) : QStringLiteral("–");
  };
  bestShown_.value->setText(said(adapting ? progress_.best : best_.best));
  mean_.value->setText(said(adapting ? progress_.mean : generation_.mean));
  speed_.value->setText(active_ && progress_.trialsPerSecond > 0
                            ? tr("%1 trials/s").arg(shortNumber(progress_.trialsPerSecond))
                            : QStringLiteral("–"));
  trialsShown_.value->setText(trials_ > 0 ? QLocale::c().toString(qlonglong(trials_)) : QStringLiteral("–"));
  bestShown_.value->setToolTip(
      adapting || !known || blind_
          ? tr("Best fitness of all generations in the newest simulator")
          : tr("Best fitness of all generations in the newest simulator: of generation %1").arg(best_.number));
  left_.value->setText(active_ ? duration(progress_.secondsLeft) : QStringLiteral("–"));

  QString message = QString::fromStdString(run_.message);
  // While it waits or is stopped, the next action already says it.
  if (face_ == RunFace::waiting || face_ == RunFace::stopped || face_ == RunFace::stopping) message.clear();
  message_->setText(message);
  message_->setVisible(!message.isEmpty());
  styleOnce(*message_, QStringLiteral("color: %1").arg((face_ == RunFace::failed ? tones.bad : tones.muted).name()));
  go_->setVisible(true);
  stop_->setVisible(true);
  go_->setText(face_ == RunFace::ready ? tr("Start") : tr("Continue"));
  go_->setEnabled(!active_ && face_ != RunFace::finished);
  stop_->setEnabled(active_ && face_ != RunFace::stopping);
}

}  // namespace btr::ui
