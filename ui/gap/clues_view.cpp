#include "ui/gap/clues_view.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "core/gap/report/report_figures.h"
#include "core/spec/figures.h"
#include "ui/common/database/reading_table.h"
#include "ui/common/numbers/format.h"
#include "ui/common/progress.h"

namespace btr::ui {
namespace {

constexpr int fewest = 3;

}  // namespace

CluesView::CluesView(const QString& program, QWidget* parent) : QWidget(parent), process_(program) {
  auto* what =
      new QLabel(tr("Without a recording the real fitness of the measured individuals is all there is. Each effect of "
                    "the library is put into the newest simulator at each place, at a usual size, and the individuals "
                    "are simulated again: the table says how much of the differences it would take away, and how "
                    "easily the best of so many does that by chance."),
                 this);
  what->setWordWrap(true);
  state_ = new QLabel(this);
  state_->setObjectName("state");
  state_->setWordWrap(true);
  ask_ = new QPushButton(tr("&Ask the measured fitness"), this);
  ask_->setObjectName("ask");
  cancel_ = new QPushButton(tr("Cancel"), this);
  cancel_->setObjectName("cancel");
  progress_ = new QProgressBar(this);
  sentence_ = new QLabel(this);
  sentence_->setObjectName("cluesSentence");
  sentence_->setWordWrap(true);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont larger = font();
  larger.setPointSizeF(larger.pointSizeF() * 1.1);
  sentence_->setFont(larger);
  table_ = new QTableWidget(this);
  table_->setObjectName("clues");
  table_->setAccessibleName(tr("Effects that would explain the differences"));
  setUpForReading(*table_, {tr("Effect"), tr("At"), tr("Takes away"), tr("p by chance"), tr("At this size")});
  table_->horizontalHeaderItem(share)->setToolTip(
      tr("Of the sum of squared differences between real and simulated fitness"));
  table_->horizontalHeaderItem(pValue)->setToolTip(
      tr("How often the best of all effects takes as much from the same differences dealt out at random among the "
         "individuals"));
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);

  auto* buttons = new QHBoxLayout;
  buttons->addWidget(ask_);
  buttons->addWidget(progress_, 1);
  buttons->addWidget(cancel_);
  buttons->addWidget(state_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(what);
  layout->addLayout(buttons);
  layout->addWidget(sentence_);
  layout->addWidget(table_, 1);

  connect(ask_, &QPushButton::clicked, this, &CluesView::ask);
  connect(cancel_, &QPushButton::clicked, &process_, &ProgramProcess::cancel);
  connect(&process_, &ProgramProcess::started, this, [this] {
    progress_->setRange(0, 0);
    refresh();
  });
  connect(&process_, &ProgramProcess::progressed, this,
          [this](const QString& stage, double part) { showProgress(*progress_, stage, part); });
  connect(&process_, &ProgramProcess::done, this, [this](const QByteArray& output) {
    try {
      const FitnessClues clues = fitnessCluesFromJson(output.toStdString());
      if (clues.run == run_) setClues(clues);
    } catch (const std::exception& error) {
      emit failed(QString::fromUtf8(error.what()));
    }
    refresh();
  });
  connect(&process_, &ProgramProcess::cancelled, this, &CluesView::refresh);
  connect(&process_, &ProgramProcess::failed, this, [this](const QString& message) {
    refresh();
    emit failed(message);
  });
  refresh();
}

void CluesView::setRun(const QString& database, Id run, int measured) {
  if (database != database_ || run != run_) {
    table_->setRowCount(0);
    sentence_->clear();
  }
  database_ = database;
  run_ = run;
  measured_ = measured;
  refresh();
}

void CluesView::setClues(const FitnessClues& clues) {
  sentence_->setText(word(clues.sentence));
  table_->setRowCount(int(clues.clues.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const FitnessClue& clue = clues.clues[std::size_t(row)];
    QStringList numbers;
    for (const auto& [name, value] : clue.effect.parameters) numbers << word(name + " = " + brief(value));
    const QStringList texts{word(inWords(clue.effect.effect)), word(clue.effect.at), word(percent(clue.share)),
                            word(brief(clue.pValue)), numbers.join(", ")};
    for (int column = 0; column < columns; ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      if (column == share || column == pValue) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      QFont strong = item->font();
      strong.setBold(std::size_t(row) < clues.alike);  // among these the differences do not choose
      item->setFont(strong);
      item->setToolTip(texts[column]);
      table_->setItem(row, column, item);
    }
  }
}

void CluesView::ask() {
  process_.start({"--json", "gap", "clues", "--db", database_, "--run", QString::number(run_), "--progress"});
}

void CluesView::refresh() {
  const bool running = process_.isRunning();
  QString why;
  if (run_ == 0)
    why = tr("Select a run first.");
  else if (measured_ < fewest)
    why = tr("%1 of this run's individuals have a real fitness; at least %2 of one stage are needed.")
              .arg(measured_)
              .arg(fewest);
  state_->setText(why);
  state_->setVisible(!running);
  ask_->setEnabled(!running && why.isEmpty());
  progress_->setVisible(running);
  cancel_->setVisible(running);
}

}  // namespace btr::ui
