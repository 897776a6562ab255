#include "ui/database/individual_details.h"

#include <QFontDatabase>
#include <QHeaderView>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/charts/plot_data.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {

IndividualDetails::IndividualDetails(QWidget* parent) : QWidget(parent) {
  title_ = new QLabel(this);
  facts_ = new QLabel(this);
  facts_->setWordWrap(true);
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  chromosome_ = new QPlainTextEdit(this);
  chromosome_->setReadOnly(true);
  chromosome_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  chromosome_->setMaximumHeight(chromosome_->fontMetrics().height() * 5 + 12);
  chromosome_->setAccessibleName(tr("Chromosome"));
  parameters_ = new QTableWidget(0, 4, this);
  parameters_->setHorizontalHeaderLabels({tr("parameter"), tr("value"), tr("unit"), tr("range")});
  parameters_->verticalHeader()->hide();
  parameters_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 7);
  parameters_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  parameters_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  parameters_->setAlternatingRowColors(true);
  parameters_->setAccessibleName(tr("Parameters"));
  replay_ = new QPushButton(themeIcon("media-playback-start"), tr("Replay"), this);
  replay_->setToolTip(tr("Run it again in 3D and compare it with the stored run"));
  connect(replay_, &QPushButton::clicked, this, [this] { emit replayRequested(individual_); });

  auto* top = new QHBoxLayout;
  top->addWidget(title_, 1);
  top->addWidget(replay_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 0, 0, 0);
  layout->addLayout(top);
  layout->addWidget(facts_);
  layout->addWidget(chromosome_);
  layout->addWidget(parameters_, 1);
  clear();
}

void IndividualDetails::setGenotype(const std::vector<Parameter>& genotype) { genotype_ = genotype; }
void IndividualDetails::setUnit(const QString& unit) { unit_ = unit; }

void IndividualDetails::clear() {
  individual_ = 0;
  title_->setText(tr("<b>No individual selected</b>"));
  facts_->clear();
  chromosome_->clear();
  chromosome_->hide();
  parameters_->setRowCount(0);
  replay_->setEnabled(false);
}

void IndividualDetails::setIndividual(const IndividualRecord& individual, int simulatorNumber, bool fitnessHidden) {
  individual_ = individual.id;
  title_->setText(tr("<b>Individual %1</b>, generation %2, slot %3")
                      .arg(individual.id)
                      .arg(individual.generation)
                      .arg(individual.slot));
  const QString fitness = fitnessHidden ? tr("hidden") : withUnit(individual.fitness, unit_);
  QStringList facts{tr("Fitness %1 in simulator %2").arg(fitness).arg(simulatorNumber),
                    tr("trial %1").arg(QString::fromStdString(individual.outcome))};
  // The detail of a kick tells how far it went.
  if (!individual.detail.empty() && !fitnessHidden) facts.last() += ": " + QString::fromStdString(individual.detail);
  if (individual.sameAs) facts << tr("same as individual %1, not simulated again").arg(individual.sameAs);
  facts << tr("seed %1").arg(individual.trialSeed);
  facts_->setText(facts.join(" · "));
  facts_->setToolTip(fitnessHidden ? QString() : exactText(individual.fitness));
  chromosome_->setVisible(!individual.chromosome.empty());
  chromosome_->setPlainText(groupedChromosome(individual.chromosome));

  parameters_->setRowCount(static_cast<int>(individual.parameters.size()));
  for (std::size_t i = 0; i < individual.parameters.size(); ++i) {
    const Parameter* declared = i < genotype_.size() ? &genotype_[i] : nullptr;
    const double value = individual.parameters[i];
    const auto set = [&](int column, const QString& text, const QString& tip) {
      auto* item = new QTableWidgetItem(text);
      item->setToolTip(tip);
      if (column == 1) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      parameters_->setItem(static_cast<int>(i), column, item);
    };
    const QString meaning = declared ? QString::fromStdString(declared->meaning) : QString();
    set(0, declared ? QString::fromStdString(declared->name) : tr("parameter %1").arg(i + 1), meaning);
    set(1, shortNumber(value), exactText(value));
    set(2, declared ? QString::fromStdString(declared->unit) : QString(), meaning);
    set(3, declared ? tr("%1 to %2").arg(shortNumber(declared->minimum), shortNumber(declared->maximum)) : QString(),
        meaning);
  }
  parameters_->resizeColumnToContents(1);
  parameters_->resizeColumnToContents(2);
  replay_->setEnabled(true);
}

QString groupedChromosome(const std::string& chromosome) {
  QString text;
  for (std::size_t i = 0; i < chromosome.size(); ++i) {
    if (i > 0 && i % 8 == 0) text += ' ';
    text += QLatin1Char(chromosome[i]);
  }
  return text;
}

}  // namespace btr::ui
