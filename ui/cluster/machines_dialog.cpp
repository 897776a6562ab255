#include "ui/cluster/machines_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/common/database/reading_table.h"
#include "ui/common/look/fit_screen.h"
#include "ui/common/look/tab_order.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/resources.h"

namespace btr::ui {
namespace {

QString percent(double share) { return QStringLiteral("%1 %").arg(100 * share, 0, 'f', 1); }

/// What a job's speed is given in: trials a second, blind cases an hour.
double inItsUnit(const JobStatus& status, double perSecond) {
  constexpr double hour_s = 3600;
  return status.areCases() ? hour_s * perSecond : perSecond;
}
QString speed(const JobStatus& status, double perSecond) {
  return perSecond > 0 ? shortNumber(inItsUnit(status, perSecond)) : QString();
}

void setRow(QTableWidget& table, int row, const QStringList& texts) {
  for (int column = 0; column < texts.size(); ++column) {
    QTableWidgetItem* item = table.item(row, column);
    if (!item) table.setItem(row, column, item = new QTableWidgetItem);
    item->setText(texts[column]);
    // What does not fit is read there.
    item->setToolTip(texts[column]);
  }
}

/// Whose underlined letter leads to the field.
QLabel* labelFor(QWidget* field, const QString& text) {
  auto* label = new QLabel(text);
  label->setBuddy(field);
  return label;
}

void setColumns(QTableWidget& table, const QStringList& headers, int rows) {
  if (table.columnCount() != headers.size()) {
    table.clear();
    setUpForReading(table, headers);
    table.horizontalHeader()->setStretchLastSection(true);
  }
  table.setHorizontalHeaderLabels(headers);  // what is counted differs from job to job
  table.setRowCount(rows);
}

}  // namespace

MachinesDialog::MachinesDialog(MachinesController& controller, std::function<QString()> database, QWidget* parent)
    : QDialog(parent), controller_(controller), database_(std::move(database)) {
  setWindowTitle(tr("On several machines"));
  setObjectName("machines");
  auto* column = new QVBoxLayout(this);
  column->addLayout(makeForm());
  message_ = new QLabel;
  message_->setObjectName("machines.message");
  message_->setWordWrap(true);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  job_ = new QLabel;
  job_->setObjectName("machines.job");
  job_->setWordWrap(true);
  parts_ = new QTableWidget;
  parts_->setObjectName("machines.parts");
  parts_->setMinimumHeight(120);
  parts_->setTabKeyNavigation(false);
  progress_ = new QProgressBar;
  progress_->setObjectName("machines.progress");
  column->addWidget(message_);
  column->addWidget(job_);
  column->addWidget(parts_, 1);
  column->addWidget(progress_);
  column->addLayout(makeButtons());
  orderTabs(*this);
  resizeWithinScreen(*this, {860, 620});
  connect(&controller_, &MachinesController::changed, this, &MachinesDialog::refresh);
  connect(&controller_, &MachinesController::told, this, &MachinesDialog::tell);
  showWay();
  refresh();
}

QLayout* MachinesDialog::makeForm() {
  file_ = new QLineEdit;
  file_->setObjectName("machines.file");
  file_->setToolTip(tr("A comparison or a grid; with MPI also an experiment"));
  auto* choose = new QPushButton(tr("Choos&e…"));
  auto* files = new QHBoxLayout;
  files->addWidget(file_, 1);
  files->addWidget(choose);
  way_ = new QComboBox;
  way_->setObjectName("machines.way");
  way_->addItem(tr("Computers that ssh reaches"));
  way_->addItem(tr("A cluster with Slurm"));
  way_->addItem(tr("Ranks of MPI"));
  workers_ = new QSpinBox;
  workers_->setObjectName("machines.workers");
  workers_->setRange(1, 1024);
  workers_->setToolTip(tr("Worker processes of each element or rank"));
  ranks_ = new QSpinBox;
  ranks_->setObjectName("machines.ranks");
  ranks_->setRange(1, 100'000);
  ranks_->setValue(2);
  ranksLabel_ = labelFor(ranks_, tr("&Ranks"));
  auto* workersLabel = labelFor(workers_, tr("&Workers of each"));
  auto* ways = new QHBoxLayout;
  ways->addWidget(way_);
  ways->addSpacing(12);
  ways->addWidget(ranksLabel_);
  ways->addWidget(ranks_);
  ways->addSpacing(12);
  ways->addWidget(workersLabel);
  ways->addWidget(workers_);
  ways->addStretch(1);
  hosts_ = new QPlainTextEdit;
  hosts_->setObjectName("machines.hosts");
  hosts_->setTabChangesFocus(true);
  hosts_->setFixedHeight(fontMetrics().lineSpacing() * 3 + 16);
  hosts_->setToolTip(tr("One a line, as ssh knows them; 2/lab2 works on two at a time"));
  hostsLabel_ = labelFor(hosts_, tr("Com&puters"));
  options_ = new QLineEdit;
  options_->setObjectName("machines.options");
  options_->setPlaceholderText(QStringLiteral("--partition=short --time=2:00:00"));
  optionsLabel_ = labelFor(options_, tr("Options of s&batch"));
  folder_ = new QLineEdit;
  folder_->setObjectName("machines.folder");
  folder_->setToolTip(tr("New or empty; for Slurm one that all machines see"));
  auto* place = new QPushButton(tr("Choo&se…"));
  auto* folders = new QHBoxLayout;
  folders->addWidget(folder_, 1);
  folders->addWidget(place);
  into_ = new QLabel;
  into_->setObjectName("machines.into");
  into_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  start_ = new QPushButton(themeIcon("media-playback-start"), tr("S&tart"));
  start_->setObjectName("machines.start");
  start_->setDefault(true);
  auto* last = new QHBoxLayout;
  last->addWidget(into_, 1);
  last->addWidget(start_);
  for (QPushButton* button : {choose, place}) button->setAutoDefault(false);

  auto* form = new QFormLayout;
  form->addRow(labelFor(file_, tr("Work &on")), files);
  form->addRow(labelFor(way_, tr("W&here")), ways);
  form->addRow(hostsLabel_, hosts_);
  form->addRow(optionsLabel_, options_);
  form->addRow(labelFor(folder_, tr("Job's &folder")), folders);
  form->addRow(tr("Results to"), last);
  connect(choose, &QPushButton::clicked, this, &MachinesDialog::chooseFile);
  connect(place, &QPushButton::clicked, this, &MachinesDialog::chooseFolder);
  connect(file_, &QLineEdit::textChanged, this, &MachinesDialog::suggestFolder);
  connect(folder_, &QLineEdit::textEdited, this, [this] { isFolderOurs_ = false; });
  connect(way_, &QComboBox::currentIndexChanged, this, &MachinesDialog::showWay);
  connect(start_, &QPushButton::clicked, this, &MachinesDialog::start);
  return form;
}

QLayout* MachinesDialog::makeButtons() {
  const auto add = [](const QString& icon, const QString& text, const char* name, const QString& toolTip) {
    auto* button = icon.isEmpty() ? new QPushButton(text) : new QPushButton(themeIcon(icon), text);
    button->setObjectName(name);
    button->setToolTip(toolTip);
    button->setAutoDefault(false);
    return button;
  };
  open_ = add("folder-open", tr("Open a &job…"), "machines.open", tr("A job's folder, of this window or another"));
  cancel_ = add("media-playback-stop", tr("&Cancel the job"), "machines.cancel", tr("What has been done is kept"));
  resume_ = add("media-playback-start", tr("Resu&me what failed"), "machines.resume",
                tr("What failed, was stopped or has not begun, alone"));
  collect_ = add("document-import", tr("Co&llect results"), "machines.collect",
                 tr("Brings what is done into the job's database"));
  auto* close = add({}, tr("Close"), "machines.close", tr("The job goes on"));
  connect(open_, &QPushButton::clicked, this, &MachinesDialog::chooseJob);
  connect(cancel_, &QPushButton::clicked, &controller_, &MachinesController::cancel);
  connect(resume_, &QPushButton::clicked, this, [this] {
    tell({}, false);
    const bool toSlurm = controller_.status().isSlurms && way() == MachinesOrder::Way::slurm;
    controller_.resume(toSlurm ? QString() : hosts_->toPlainText());
  });
  connect(collect_, &QPushButton::clicked, &controller_, &MachinesController::collect);
  connect(close, &QPushButton::clicked, this, &QDialog::close);
  auto* row = new QHBoxLayout;
  row->addWidget(open_);
  row->addStretch(1);
  for (QPushButton* button : {cancel_, resume_, collect_, close}) row->addWidget(button);
  return row;
}

MachinesOrder::Way MachinesDialog::way() const { return MachinesOrder::Way(way_->currentIndex()); }

MachinesOrder MachinesDialog::order() const {
  MachinesOrder order;
  order.way = way();
  order.file = file_->text().trimmed();
  order.database = database_();
  order.folder = folder_->text().trimmed();
  order.hosts = hosts_->toPlainText();
  order.options = options_->text();
  order.ranks = ranks_->value();
  order.workers = workers_->value();
  return order;
}

void MachinesDialog::setFile(const QString& file) { file_->setText(file); }

void MachinesDialog::chooseFile() {
  const QString from = file_->text().isEmpty() ? resourceDirectory() : file_->text();
  const QString chosen =
      QFileDialog::getOpenFileName(this, tr("A comparison, a grid or an experiment"), from, tr("Files (*.json)"));
  if (!chosen.isEmpty()) setFile(chosen);
}

void MachinesDialog::chooseFolder() {
  const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder of the job"), folder_->text());
  if (chosen.isEmpty()) return;
  folder_->setText(chosen);
  isFolderOurs_ = false;
}

void MachinesDialog::chooseJob() {
  const QString chosen = QFileDialog::getExistingDirectory(this, tr("A job's folder"), folder_->text());
  if (chosen.isEmpty()) return;
  tell({}, false);
  controller_.open(chosen);
  if (const QString hosts = controller_.hosts(); !hosts.isEmpty()) hosts_->setPlainText(hosts);
}

// Beside the database: "worn-knee-job", "worn-knee-job-2", …
void MachinesDialog::suggestFolder() {
  if (!isFolderOurs_ || database_().isEmpty() || file_->text().isEmpty()) return;
  const QString base =
      QFileInfo(database_()).absolutePath() + "/" + QFileInfo(file_->text()).completeBaseName() + "-job";
  QString folder = base;
  for (int k = 2; QFileInfo::exists(folder); ++k) folder = QStringLiteral("%1-%2").arg(base).arg(k);
  folder_->setText(folder);
}

void MachinesDialog::start() {
  suggestFolder();
  tell({}, false);
  controller_.start(order());
}

void MachinesDialog::showWay() {
  const bool isSlurm = way() == MachinesOrder::Way::slurm, isRanks = way() == MachinesOrder::Way::ranks;
  for (QWidget* each : {static_cast<QWidget*>(hosts_), static_cast<QWidget*>(hostsLabel_)}) each->setVisible(!isSlurm);
  for (QWidget* each : {static_cast<QWidget*>(options_), static_cast<QWidget*>(optionsLabel_)})
    each->setVisible(isSlurm);
  for (QWidget* each : {static_cast<QWidget*>(ranks_), static_cast<QWidget*>(ranksLabel_)}) each->setVisible(isRanks);
  hosts_->setPlaceholderText(isRanks ? tr("none: this one") : QStringLiteral("lab1\n2/ada@lab2"));
  hosts_->viewport()->update();
}

QString MachinesDialog::speedTitle(const JobStatus& status) const {
  return status.areCases() ? tr("Cases/h") : tr("Trials/s");
}

void MachinesDialog::showArray(const JobStatus& status) {
  setColumns(*parts_, {tr("Element"), tr("State"), tr("Done"), tr("Host"), speedTitle(status), tr("Why")},
             int(status.parts.size()));
  for (int row = 0; const JobPart& part : status.parts)
    setRow(*parts_, row++,
           {part.name, part.state, percent(part.share), part.host,
            part.state == "running" ? speed(status, part.trialsPerSecond) : QString(), part.note});
}

void MachinesDialog::showRanks(const JobStatus& status) {
  setColumns(*parts_,
             {tr("Host"), tr("Workers"), tr("Pieces"), status.areCases() ? tr("Cases") : tr("Trials"),
              speedTitle(status), tr("Lost"), QString()},
             int(status.parts.size()));
  for (int row = 0; const JobPart& part : status.parts)
    setRow(*parts_, row++,
           {part.name, QString::number(part.workers), QString::number(part.pieces), QString::number(part.trials),
            speed(status, part.trialsPerSecond), QString::number(part.lost), QString()});
}

void MachinesDialog::showJob(const JobStatus& status) {
  if (status.kind == JobStatus::Kind::ranks)
    showRanks(status);
  else
    showArray(status);
  progress_->setRange(0, 1000);
  progress_->setValue(int(status.share * 1000));
  QString text = tr("%p %");
  if (!status.stage.isEmpty()) text = QString(status.stage).replace('%', "%%") + QStringLiteral(" · ") + text;
  if (controller_.isGoing()) {
    if (status.trialsPerSecond > 0)
      text +=
          (status.areCases() ? tr(" · %1 cases/h") : tr(" · %1 trials/s")).arg(speed(status, status.trialsPerSecond));
    if (status.secondsLeft > 0) text += tr(" · about %1 left").arg(duration(status.secondsLeft));
  }
  progress_->setFormat(text);
}

void MachinesDialog::refresh() {
  const JobStatus& status = controller_.status();
  const bool isGoing = controller_.isGoing(), isThere = controller_.isKnown(), isFree = !controller_.isAsked();
  const bool isArray = status.kind == JobStatus::Kind::array;
  into_->setText(database_().isEmpty() ? tr("no database is open") : database_());
  if (controller_.folder().isEmpty()) {
    job_->setText(tr("No job is open."));
  } else if (!isThere) {
    job_->setText(isGoing || !isFree ? tr("%1: is being begun…").arg(controller_.folder()) : controller_.folder());
  } else if (!isArray) {
    job_->setText(tr("%1: %2").arg(controller_.folder(), isGoing             ? tr("ranks are at work")
                                                         : status.share >= 1 ? tr("finished")
                                                                             : tr("nobody works on it")));
  } else {
    job_->setText(tr("%1: %2 elements, %3 done, %4 running, %5 failed")
                      .arg(controller_.folder())
                      .arg(status.parts.size())
                      .arg(status.count("done") + status.count("waiting"))
                      .arg(status.count("running"))
                      .arg(status.count("failed")));
  }
  if (isThere) {
    showJob(status);
  } else {
    setColumns(*parts_, {tr("Element"), tr("State"), tr("Done"), tr("Host"), tr("Trials/s"), tr("Why")}, 0);
    progress_->setRange(0, isGoing ? 0 : 1000);
    progress_->setValue(0);
    progress_->setFormat(QString());
  }
  start_->setEnabled(isFree);
  cancel_->setEnabled(isFree && isGoing);
  resume_->setEnabled(isFree && isThere && !isGoing && (isArray ? status.resumable() > 0 : status.share < 1));
  collect_->setEnabled(isFree && isThere && isArray && status.count("done") + status.count("waiting") > 0);
}

void MachinesDialog::tell(const QString& sentence, bool isProblem) {
  message_->setText(sentence);
  message_->setVisible(!sentence.isEmpty());
  message_->setStyleSheet(isProblem ? QStringLiteral("color: %1").arg(tonesOf(palette()).bad.name()) : QString());
}

}  // namespace btr::ui
