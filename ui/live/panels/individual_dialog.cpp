#include "ui/live/panels/individual_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QStandardPaths>
#include <QTableWidget>
#include <QVBoxLayout>
#include <map>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "ui/common/database/database_reader.h"
#include "ui/common/look/fit_screen.h"
#include "ui/common/numbers/format.h"
#include "ui/live/stored_controller.h"

namespace btr::ui {

IndividualDialog::IndividualDialog(DatabaseReader& reader, const PluginHost& host, QWidget* parent)
    : QDialog(parent), reader_(reader), host_(host) {
  setObjectName("individualDialog");
  setWindowTitle(tr("A stored individual as controller"));
  run_ = new QComboBox(this);
  run_->setObjectName("individualRun");
  run_->setAccessibleName(tr("Run"));
  connect(run_, &QComboBox::currentIndexChanged, this, &IndividualDialog::askIndividuals);
  auto* label = new QLabel(tr("&Run"), this);
  label->setBuddy(run_);
  table_ = new QTableWidget(0, 3, this);
  table_->setObjectName("individualTable");
  table_->setAccessibleName(tr("Individuals"));
  table_->setHorizontalHeaderLabels({tr("Individual"), tr("Generation"), tr("Fitness")});
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setTabKeyNavigation(false);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->setToolTip(tr("The best ones first, at most %1").arg(most));
  connect(table_, &QTableWidget::cellDoubleClicked, this, &IndividualDialog::choose);
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  message_->hide();
  buttons_ = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  buttons_->button(QDialogButtonBox::Ok)->setText(tr("&Play it"));
  buttons_->button(QDialogButtonBox::Ok)->setEnabled(false);
  connect(buttons_, &QDialogButtonBox::accepted, this, &IndividualDialog::choose);
  connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(label);
  column->addWidget(run_);
  column->addWidget(table_, 1);
  column->addWidget(message_);
  column->addWidget(buttons_);
  resizeWithinScreen(*this, {460, 420});
  askRuns();
}

void IndividualDialog::say(const QString& why) {
  message_->setText(why);
  message_->setVisible(!why.isEmpty());
}

void IndividualDialog::askRuns() {
  struct Runs {
    std::vector<ExperimentRecord> experiments;
    std::vector<RunRecord> runs;
  };
  reader_.read(
      this, "runs", tr("the runs"),
      [](const Database& database) {
        return Runs{database.experiments(), database.runs()};
      },
      [this](Runs found) {
        std::map<Id, QString> names;
        for (const ExperimentRecord& experiment : found.experiments) names[experiment.id] = word(experiment.name);
        runs_.clear();
        for (RunRecord& run : found.runs) {
          if (run.generation == 0) continue;
          run_->addItem(tr("%1, run %2").arg(names[run.experiment]).arg(run.id), qlonglong(run.id));
          runs_.push_back(std::move(run));
        }
        if (runs_.empty()) say(tr("No run of this database has an individual yet."));
      },
      [this](const QString& why) { say(why); });
}

void IndividualDialog::askIndividuals() {
  const Id id = run_->currentData().toLongLong();
  if (id == 0) return;
  struct Content {
    RunRecord run;
    std::vector<IndividualRecord> individuals;
  };
  reader_.read(
      this, "individuals", tr("the individuals of run %1").arg(id),
      [id](const Database& database) {
        return Content{database.run(id), database.bestIndividuals(id, most, 1, 0)};
      },
      [this](Content found) {
        for (RunRecord& run : runs_)
          if (run.id == found.run.id) run = found.run;
        fill(found.individuals);
      },
      [this](const QString& why) { say(why); });
}

void IndividualDialog::fill(const std::vector<IndividualRecord>& individuals) {
  individuals_ = individuals;
  table_->setRowCount(int(individuals.size()));
  for (int i = 0; i < table_->rowCount(); ++i) {
    const IndividualRecord& each = individuals[std::size_t(i)];
    table_->setItem(i, 0, new QTableWidgetItem(QString::number(each.id)));
    table_->setItem(i, 1, new QTableWidgetItem(QString::number(each.generation)));
    table_->setItem(i, 2, new QTableWidgetItem(shortNumber(each.fitness)));
  }
  if (!individuals.empty()) table_->selectRow(0);
  buttons_->button(QDialogButtonBox::Ok)->setEnabled(!individuals.empty());
  say({});
}

void IndividualDialog::choose() {
  const int row = table_->currentRow(), run = run_->currentIndex();
  if (row < 0 || std::size_t(row) >= individuals_.size() || run < 0) return;
  try {
    const QString sticks = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + "/sticks";
    emit chosen(storedController(runs_[std::size_t(run)], individuals_[std::size_t(row)], host_, sticks.toStdString()));
    accept();
  } catch (const InputError& error) {
    say(QString::fromUtf8(error.what()));
  }
}

}  // namespace btr::ui
