#include "ui/measure/policy_page.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/gap/report/report_figures.h"
#include "core/spec/figures.h"
#include "ui/common/database/reading_table.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {

QString meanText(double mean, double standardError) {
  if (!(standardError > 0)) return word(brief(mean));
  return QStringLiteral("%1 ± %2").arg(word(brief(mean)), word(digits(standardError, 2)));
}

QString groupText(const PolicyGroup& group) {
  if (group.count == 0) return QStringLiteral("–");
  return QStringLiteral("%1  (%2)").arg(meanText(group.mean, group.standardError)).arg(group.count);
}

QString signedText(double value) { return (value > 0 ? QStringLiteral("+") : QString()) + word(brief(value)); }

QString verdictOf(const StepRow& row) {
  if (!row.centreAfter) return row.isSignificant() ? PolicyPage::tr("significant so far") : PolicyPage::tr("open");
  if (row.gradient.step == 0) return PolicyPage::tr("stays");
  if (!row.gradient.pValue) return PolicyPage::tr("too few policies to tell");
  return row.isSignificant() ? PolicyPage::tr("significant") : PolicyPage::tr("not significant");
}

void put(QTableWidget& table, int row, int column, const QString& text, bool number, const QColor& colour = {}) {
  auto* item = new QTableWidgetItem(text);
  if (number) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  if (colour.isValid()) item->setForeground(colour);
  item->setToolTip(text);
  table.setItem(row, column, item);
}

QTableWidget* readingTable(const QString& name, const QString& accessible, const QStringList& headers,
                           QWidget* parent) {
  auto* table = new QTableWidget(parent);
  table->setObjectName(name);
  table->setAccessibleName(accessible);
  setUpForReading(*table, headers);
  table->setWordWrap(false);
  table->horizontalHeader()->setStretchLastSection(true);
  return table;
}

}  // namespace

QString sentenceOf(const RealityReport& report) {
  const auto known = std::count_if(report.policies.begin(), report.policies.end(),
                                   [](const PolicyRow& p) { return p.fitness.has_value(); });
  if (report.wasEnded)
    return PolicyPage::tr("Ended by a person after %1 of %2 policies: what was measured counts, no step was taken.")
        .arg(known)
        .arg(report.policies.size());
  if (!report.isFinished)
    return PolicyPage::tr("%1 of %2 policies are measured; the step is taken when all are.")
        .arg(known)
        .arg(report.policies.size());
  if (report.steps.empty())
    return PolicyPage::tr("%1 policies; this learner has no single step to show.").arg(report.policies.size());
  const auto moved =
      std::count_if(report.steps.begin(), report.steps.end(), [](const StepRow& s) { return s.gradient.step != 0; });
  const auto sure = std::count_if(report.steps.begin(), report.steps.end(),
                                  [](const StepRow& s) { return s.gradient.step != 0 && s.isSignificant(); });
  if (moved == 0) return PolicyPage::tr("No parameter promised to do better elsewhere: the centre stays.");
  const auto unknown = std::count_if(report.steps.begin(), report.steps.end(),
                                     [](const StepRow& s) { return s.gradient.step != 0 && !s.gradient.pValue; });
  const QString all = PolicyPage::tr("%1 of %2 parameters moved").arg(moved).arg(report.steps.size());
  if (unknown == moved) return PolicyPage::tr("%1: too few policies to tell their differences from chance.").arg(all);
  const QString text =
      PolicyPage::tr("%1, %2 of them by a difference that chance does not explain (5 %).").arg(all).arg(sure);
  return unknown == 0 ? text : text + ' ' + PolicyPage::tr("For %1 there are too few policies to tell.").arg(unknown);
}

PolicyPage::PolicyPage(QWidget* parent)
    : QWidget(parent),
      iteration_(new QComboBox(this)),
      sentence_(new QLabel(this)),
      end_(new QPushButton(tr("End L2 here…"), this)),
      tables_(new QTabWidget(this)) {
  iteration_->setObjectName("iteration");
  iteration_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  iteration_->setAccessibleName(tr("Iteration of L2"));
  iteration_->setToolTip(tr("Which iteration of learning in reality is shown"));
  sentence_->setObjectName("sentence");
  sentence_->setWordWrap(true);
  end_->setObjectName("endL2");
  end_->setToolTip(
      tr("No further policies: the best one measured so far goes back, and the simulator is adapted (L3)"));
  connect(end_, &QPushButton::clicked, this, &PolicyPage::confirmEnd);
  steps_ = readingTable("steps", tr("Averages and steps"),
                        {tr("Parameter"), tr("Step"), tr("Verdict"), tr("p"), tr("Mean at −ε (policies)"),
                         tr("Unchanged"), tr("Mean at +ε"), tr("Centre"), tr("New centre")},
                        this);
  steps_->horizontalHeaderItem(below)->setToolTip(
      tr("Mean real fitness of the policies below the centre ± its standard error, and how many these are"));
  steps_->horizontalHeaderItem(pValue)->setToolTip(
      tr("Probability of a difference as large as that of the compared groups if it were chance alone (Welch); – where "
         "one of them has fewer than two policies"));
  steps_->horizontalHeaderItem(verdict)->setToolTip(
      tr("Significant: p below 5 %. The step is taken either way; it says which of them to believe."));
  policies_ = readingTable("policies", tr("Policies"),
                           {tr("Individual"), tr("Changes"), tr("Simulated"), tr("Real"), tr("Values")}, this);
  policies_->horizontalHeaderItem(changes)->setToolTip(
      tr("Each parameter in its order: + above the centre, − below it, · unchanged"));
  connect(policies_, &QTableWidget::cellDoubleClicked, this, [this](int row, int) {
    const auto at = static_cast<std::size_t>(iteration_->currentIndex());
    emit replayRequested(reports_.at(at).policies.at(static_cast<std::size_t>(row)).individual);
  });

  auto* bar = new QHBoxLayout;
  bar->setContentsMargins(8, 6, 8, 2);
  bar->addWidget(iteration_);
  bar->addWidget(sentence_, 1);
  bar->addWidget(end_);
  tables_->setDocumentMode(true);
  tables_->addTab(steps_, tr("Steps"));
  tables_->addTab(policies_, tr("Policies"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addLayout(bar);
  column->addWidget(tables_, 1);
  connect(iteration_, &QComboBox::currentIndexChanged, this, &PolicyPage::showReport);
  setWaiting(false);
  setReports({});
}

void PolicyPage::setUnit(const QString& unit) {
  unit_ = unit;
  const QString inUnit = unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(unit);
  steps_->horizontalHeaderItem(below)->setText(tr("Mean at −ε%1 (policies)").arg(inUnit));
  steps_->horizontalHeaderItem(same)->setText(tr("Unchanged") + inUnit);
  steps_->horizontalHeaderItem(above)->setText(tr("Mean at +ε") + inUnit);
  policies_->horizontalHeaderItem(simulated)->setText(tr("Simulated") + inUnit);
  policies_->horizontalHeaderItem(real)->setText(tr("Real") + inUnit);
}

void PolicyPage::setWaiting(bool waits) { end_->setVisible(waits); }

void PolicyPage::confirmEnd() {
  auto* box = new QMessageBox(QMessageBox::Question, tr("End learning in reality"),
                              tr("End learning in reality in this stage? This cannot be taken back."),
                              QMessageBox::NoButton, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setInformativeText(
      tr("What was measured is kept. An iteration that is not measured completely takes no step. The best goes back "
         "into the simulator and L3 follows."));
  auto* end = box->addButton(tr("End L2"), QMessageBox::AcceptRole);
  end->setObjectName("confirmEnd");
  box->setDefaultButton(box->addButton(tr("Go on measuring"), QMessageBox::RejectRole));
  connect(box, &QMessageBox::finished, this, [this, box, end] {
    if (box->clickedButton() == end) emit endRequested();
  });
  box->open();
}

void PolicyPage::setReports(std::vector<RealityReport> reports) {
  const int looked = iteration_->currentIndex();
  const bool atNewest = looked + 1 == iteration_->count();
  reports_ = std::move(reports);
  {
    const QSignalBlocker quiet(iteration_);
    iteration_->clear();
    for (const RealityReport& report : reports_)
      iteration_->addItem(tr("Stage %1, iteration %2").arg(report.stage).arg(report.number));
    const int last = iteration_->count() - 1;
    iteration_->setCurrentIndex(atNewest ? last : std::min(looked, last));
  }
  iteration_->setEnabled(iteration_->count() > 0);
  showReport(iteration_->currentIndex());
}

void PolicyPage::showReport(int index) {
  steps_->setRowCount(0);
  policies_->setRowCount(0);
  if (index < 0) {
    sentence_->setText(
        tr("This run has not learned in reality yet. The section L2 of an experiment says when it does."));
    return;
  }
  const RealityReport& report = reports_.at(static_cast<std::size_t>(index));
  sentence_->setText(sentenceOf(report));
  tables_->setTabVisible(tables_->indexOf(steps_), !report.steps.empty());
  showSteps(report);
  showPolicies(report);
}

void PolicyPage::showSteps(const RealityReport& report) {
  const Tones tones = tonesOf(palette());
  steps_->setRowCount(static_cast<int>(report.steps.size()));
  for (int row = 0; row < steps_->rowCount(); ++row) {
    const StepRow& s = report.steps[static_cast<std::size_t>(row)];
    const QString name = word(s.parameter.name) + (s.parameter.unit.empty() ? "" : " [" + word(s.parameter.unit) + "]");
    put(*steps_, row, parameter, name, false);
    put(*steps_, row, below, groupText(s.gradient.below), true);
    put(*steps_, row, same, groupText(s.gradient.same), true);
    put(*steps_, row, above, groupText(s.gradient.above), true);
    put(*steps_, row, pValue, s.gradient.pValue ? word(digits(*s.gradient.pValue, 2)) : QStringLiteral("–"), true);
    put(*steps_, row, verdict, verdictOf(s), false, s.isSignificant() ? tones.good : tones.muted);
    put(*steps_, row, before, word(brief(s.centreBefore)), true);
    put(*steps_, row, step, s.centreAfter ? signedText(s.gradient.step) : QStringLiteral("–"), true);
    put(*steps_, row, after, s.centreAfter ? word(brief(*s.centreAfter)) : QStringLiteral("–"), true);
  }
}

void PolicyPage::showPolicies(const RealityReport& report) {
  policies_->setRowCount(static_cast<int>(report.policies.size()));
  std::optional<double> best;
  for (const PolicyRow& p : report.policies)
    if (p.fitness && (!best || *p.fitness > *best)) best = p.fitness;
  const Tones tones = tonesOf(palette());
  for (int row = 0; row < policies_->rowCount(); ++row) {
    const PolicyRow& p = report.policies[static_cast<std::size_t>(row)];
    QString signs;
    for (const int change : p.changes) signs += change > 0 ? u'+' : change < 0 ? u'−' : u'·';
    put(*policies_, row, individual, QString::number(p.individual), true);
    put(*policies_, row, changes, signs.isEmpty() ? QStringLiteral("–") : signs, false);
    put(*policies_, row, simulated, report.isFinished ? word(brief(p.simulated)) : tr("hidden"), true);
    put(*policies_, row, real, p.fitness ? meanText(*p.fitness, p.standardError) : QStringLiteral("–"), true,
        p.fitness && p.fitness == best ? tones.good : QColor());
    put(*policies_, row, values, QString::number(p.count), true);
  }
}

}  // namespace btr::ui
