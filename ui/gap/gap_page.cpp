#include "ui/gap/gap_page.h"

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QTabWidget>
#include <QToolBar>
#include <QVBoxLayout>

#include <utility>

#include "core/gap/replay/number_table.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_html.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_text.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/run/reality/adoption.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/clues_view.h"
#include "ui/gap/report_view.h"
#include "ui/window/scroll_page.h"

namespace btr::ui {
namespace {
constexpr const char* simulatorBefore = "simulator_before.json";

QString nothingToAdopt(GapReport::Verdict verdict) {
  return verdict == GapReport::Verdict::noMismatch
             ? GapPage::tr("There is nothing to adopt: the simulator as given agrees with the recordings.")
             : GapPage::tr("There is nothing to adopt: the recordings cannot tell the simulator from reality.");
}

}  // namespace

GapPage::GapPage(const QString& program, QWidget* parent) : QWidget(parent), process_(program) {
  setup_ = new AnalysisSetup(this);
  view_ = new ReportView(this);
  clues_ = new CluesView(program, this);
  into_ = new QComboBox(this);
  into_->setObjectName("adoptInto");
  into_->setAccessibleName(tr("Adopt into"));
  into_->setToolTip(tr("Who takes the repaired simulator: the selected run, or the scene by itself (a rig)"));
  into_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  tabs_ = new QTabWidget(this);
  tabs_->setObjectName("gapTabs");
  tabs_->addTab(setup_, tr("Anal&ysis"));
  tabs_->addTab(new ScrollPage(view_, this), tr("Repor&t"));
  tabs_->addTab(new ScrollPage(clues_, this), tr("Fitness alo&ne"));
  tabs_->setTabToolTip(2, tr("What the measured fitness of a run says without any recording"));
  makeActions();

  auto* bar = new QToolBar(this);
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->setIconSize({18, 18});
  bar->addActions({open_, export_});
  bar->addSeparator();
  bar->addActions({adopt_, revert_});
  bar->addWidget(into_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(bar);
  layout->addWidget(tabs_, 1);

  connect(setup_, &AnalysisSetup::startRequested, this, &GapPage::start);
  connect(setup_, &AnalysisSetup::cancelRequested, &process_, &AnalysisProcess::cancel);
  connect(setup_, &AnalysisSetup::failed, this, &GapPage::failed);
  connect(setup_, &AnalysisSetup::mended, this, &GapPage::mended);
  connect(setup_, &AnalysisSetup::changed, this, [this] {
    if (!refused_.isEmpty() && setup_->problem() != refused_) emit mended(std::exchange(refused_, {}));
  });
  connect(&process_, &AnalysisProcess::started, this, [this] { setup_->setRunning(true); });
  connect(&process_, &AnalysisProcess::progressed, setup_, &AnalysisSetup::showProgress);
  connect(&process_, &AnalysisProcess::finished, this, [this](const QString& folder) {
    setup_->setRunning(false);
    openReport(folder);
  });
  connect(&process_, &AnalysisProcess::cancelled, this, [this] {
    setup_->setRunning(false);
    forgetFolder();
    emit informed(tr("The analysis was cancelled; nothing was written."));
  });
  connect(&process_, &AnalysisProcess::failed, this, [this](const QString& message) {
    setup_->setRunning(process_.isRunning());
    if (!process_.isRunning()) forgetFolder();
    emit failed(message);
  });
  connect(clues_, &CluesView::failed, this, &GapPage::failed);
  connect(view_, &ReportView::timeChosen, this, &GapPage::timeChosen);
  connect(view_, &ReportView::saveNextRequested, this, [this] {
    const QString file = QFileDialog::getSaveFileName(this, tr("Save the commands"), folder_ + "/next_command.csv",
                                                      tr("Tables (*.csv)"));
    if (!file.isEmpty()) saveNext(file);
  });
  refresh();
}

void GapPage::makeActions() {
  open_ = new QAction(themeIcon("document-open"), tr("Open report…"), this);
  open_->setToolTip(tr("The folder of a report that is there already"));
  export_ = new QAction(themeIcon("document-export"), tr("Export…"), this);
  export_->setToolTip(tr("One page with everything (.html), or its numbers (.json)"));
  adopt_ = new QAction(themeIcon("dialog-ok-apply"), tr("Adopt"), this);
  adopt_->setObjectName("adopt");
  revert_ = new QAction(themeIcon("edit-undo"), tr("Revert"), this);
  revert_->setObjectName("revert");
  connect(open_, &QAction::triggered, this, [this] {
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder of a gap report"), folder_);
    if (!chosen.isEmpty()) openReport(chosen);
  });
  connect(export_, &QAction::triggered, this, [this] {
    const QString file = QFileDialog::getSaveFileName(this, tr("Export the report"), folder_ + "/../gap-report.html",
                                                      tr("Page (*.html);;Numbers (*.json)"));
    if (!file.isEmpty()) exportTo(file);
  });
  connect(adopt_, &QAction::triggered, this, [this] {
    if (target() && confirmAdoption())
      emit adoptRequested(QDir(folder_).filePath("simulator.json"), folder_, target()->rig);
  });
  connect(revert_, &QAction::triggered, this, [this] {
    if (target()) emit revertRequested(target()->rig);
  });
  connect(into_, &QComboBox::activated, this, [this] {
    chosen_ = true;
    refresh();
  });
}

// What was found may fit what was fitted, and mislead elsewhere: that is said where it is taken over.
bool GapPage::confirmAdoption() {
  const std::string warning = view_->report() ? unseenWarning(*view_->report()) : "";
  if (warning.empty()) return true;
  QMessageBox box(QMessageBox::Warning, tr("Adopt the simulator"),
                  tr("In this simulator %1. Adopt it all the same?").arg(word(warning)), QMessageBox::Cancel, this);
  box.setInformativeText(
      tr("It fits the recordings that were fitted and misleads on motions like those that were held out. Record and "
         "fit some of those first."));
  auto* yes = box.addButton(tr("Adopt it"), QMessageBox::AcceptRole);
  yes->setObjectName("adoptWorse");
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == yes;
}

void GapPage::start() {
  refused_ = setup_->problem();
  if (!refused_.isEmpty()) return emit failed(refused_);
  if (const QString asked = setup_->job().out; setup_->keepEarlierReport())
    emit informed(tr("%1 keeps its report; this one goes to %2.").arg(asked, setup_->job().out));
  AnalysisJob job = setup_->job();
  made_.clear();
  try {
    if (const QString text = setup_->simulatorText(); !text.isEmpty()) {
      // Kept beside the report: it says what "as given" was.
      job.simulator = QDir(job.out).filePath(simulatorBefore);
      if (!QDir(job.out).exists()) made_ = job.out;
      QDir().mkpath(job.out);
      writeFile(job.simulator.toStdString(), text.toStdString());
    }
  } catch (const std::exception& error) {
    return emit failed(QString::fromUtf8(error.what()));
  }
  process_.start(job);
}

void GapPage::forgetFolder() {
  if (made_.isEmpty()) return;
  QFile::remove(QDir(made_).filePath(simulatorBefore));
  QDir().rmdir(made_);  // only an empty one
  made_.clear();
}

bool GapPage::openReport(const QString& folder) {
  try {
    auto report = std::make_shared<const GapReport>(loadReport(folder.toStdString()));
    folder_ = QDir(folder).absolutePath();
    chosen_ = false;
    view_->setReport(std::move(report));
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
    return false;
  }
  tabs_->setCurrentIndex(1);  // the report
  refresh();
  emit reportOpened(folder_);
  return true;
}

void GapPage::setTargets(std::vector<AdoptionTarget> targets, std::size_t first) {
  const AdoptionTarget* before = target();
  const bool wasRig = before && !before->rig.isEmpty();
  targets_ = std::move(targets);
  QStringList texts, known;
  for (const AdoptionTarget& one : targets_)
    texts << (one.versions.empty() ? one.name
                                   : tr("%1, simulator version %2").arg(one.name).arg(one.versions.back().number));
  for (int i = 0; i < into_->count(); ++i) known << into_->itemText(i);
  // Called again and again while a run works: an open list is left alone.
  if (texts != known) {
    into_->clear();
    into_->addItems(texts);
  }
  std::size_t shown = first;
  for (std::size_t i = 0; chosen_ && i < targets_.size(); ++i)
    if (targets_[i].rig.isEmpty() != wasRig) shown = i;
  into_->setCurrentIndex(int(shown));
  into_->setEnabled(targets_.size() > 1);
  into_->setVisible(!targets_.empty());
  refresh();
}

void GapPage::setStarts(const std::vector<AdoptionTarget>& owners) {
  QStringList names, texts;
  for (const AdoptionTarget& owner : owners)
    for (auto version = owner.versions.rbegin(); version != owner.versions.rend(); ++version) {
      if (version->rig != 0 && version->number == 0) continue;  // the scene as given, which is there already
      names << tr("%1, version %2 by %3").arg(owner.name).arg(version->number).arg(word(originOf(*version)));
      texts << QString::fromStdString(toJsonText(version->simulator));
    }
  setup_->setSimulators(names, texts);
}

const AdoptionTarget* GapPage::target() const {
  const int index = into_->currentIndex();
  return index >= 0 && index < int(targets_.size()) ? &targets_[std::size_t(index)] : nullptr;
}

void GapPage::setMeasured(const QString& database, Id run, int measured) {
  clues_->setRun(database, run, measured);
  if (!database.isEmpty()) setup_->setReportBase(QFileInfo(database).absolutePath());
}

void GapPage::refresh() {
  const bool open = view_->report() != nullptr;
  export_->setEnabled(open);
  const bool found = open && leavesSomethingToAdopt(view_->report()->verdict);
  const AdoptionTarget* into = target();
  const bool ofRig = into && !into->rig.isEmpty();
  const std::size_t versions = into ? into->versions.size() : 0;
  const QString blocked = into ? into->why : tr("Select a run first.");
  adopt_->setEnabled(found && blocked.isEmpty() && (ofRig || versions > 0));
  revert_->setEnabled(blocked.isEmpty() && versions > 1);
  adopt_->setToolTip(
      !open                ? tr("Open a report first.")
      : !found             ? nothingToAdopt(view_->report()->verdict)
      : !blocked.isEmpty() ? blocked
      : ofRig ? tr("The repaired simulator becomes the rig's newest version; nothing is changed or deleted")
              : tr("The run goes on with the repaired simulator, as a new version; nothing is changed or deleted"));
  revert_->setToolTip(!blocked.isEmpty() ? blocked
                      : versions > 1     ? tr("Back to the version before the newest one, as a new version")
                      : ofRig            ? tr("The rig has nothing that could be taken back.")
                                         : tr("The run has its first simulator still."));
}

bool GapPage::exportTo(const QString& file) {
  if (!view_->report()) return false;
  try {
    const bool page = QFileInfo(file).suffix().toLower() != "json";
    writeFile(file.toStdString(), page ? toHtml(*view_->report()) : toJsonText(*view_->report()));
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
    return false;
  }
  emit informed(tr("Written: %1").arg(file));
  return true;
}

bool GapPage::saveNext(const QString& file) {
  if (!view_->report() || view_->report()->next.columns.empty()) return false;
  try {
    const GapReport::NextRecording& next = view_->report()->next;
    writeFile(file.toStdString(), toCsv(NumberTable{next.channels, next.columns}));
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
    return false;
  }
  emit informed(tr("Written: %1").arg(file));
  return true;
}

}  // namespace btr::ui
