#include "ui/gap/effects_table.h"

#include <QHeaderView>
#include <array>
#include <utility>

#include "core/gap/report/report_figures.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/figures.h"
#include "ui/common/database/reading_table.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {

void prepare(QTableWidget& table, const QStringList& headers) {
  setUpForReading(table, headers);
  table.setWordWrap(false);
  table.horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
}

QTableWidgetItem* fillCell(QTableWidget& table, int row, int column, const QString& text, bool number = false) {
  auto* item = new QTableWidgetItem(text);
  if (number) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  item->setToolTip(text);
  table.setItem(row, column, item);
  return item;
}

/// A scene's path ends in its unit: "robots.leg.servos.knee.max_torque_nm". Without one it is a pure number, but for
/// the gains of a servo, whose unit depends on its joint: nothing is said of these.
QString unitOfPath(const std::string& path) {
  constexpr std::array<std::pair<const char*, const char*>, 19> endings{{{"_nm_s_rad", "N·m·s/rad"},
                                                                         {"_nm_per_a", "N·m/A"},
                                                                         {"_v_per_rad", "V/rad"},
                                                                         {"_nm_rad", "N·m/rad"},
                                                                         {"_kg_m2", "kg·m²"},
                                                                         {"_rad_s", "rad/s"},
                                                                         {"_m_s2", "m/s²"},
                                                                         {"_n_s_m", "N·s/m"},
                                                                         {"_m_s", "m/s"},
                                                                         {"_n_m", "N/m"},
                                                                         {"_ohm", "Ω"},
                                                                         {"_nm", "N·m"},
                                                                         {"_kg", "kg"},
                                                                         {"_rad", "rad"},
                                                                         {"_m", "m"},
                                                                         {"_s", "s"},
                                                                         {"_v", "V"},
                                                                         {"_a", "A"},
                                                                         {"_n", "N"}}};
  for (const auto& [ending, unit] : endings)
    if (path.ends_with(ending)) return QString::fromUtf8(unit);
  const std::string leaf = path.substr(path.rfind('.') + 1);
  return leaf == "p" || leaf == "i" || leaf == "d" ? QString() : QStringLiteral("1");
}

}  // namespace

EffectsTable::EffectsTable(QWidget* parent) : QTableWidget(parent) {
  setAccessibleName(tr("Effects that were tried"));
  setObjectName("effects");
  prepare(*this, {tr("Effect"), tr("At"), tr("Verdict"), tr("Reason"), tr("Cross-validated gain"), tr("p"), tr("q"),
                  tr("Screening"), tr("Cannot be told from"), tr("Parameters [95 %]")});
  horizontalHeaderItem(gain)->setToolTip(
      tr("1 − error with it / error without, cross-validated: alternate blocks of the trials predict each other, with "
         "the numbers as either half would have them (one linear step from the fit to everything; initial states are "
         "those of that fit). Held-out recordings have no part in it."));
  horizontalHeaderItem(pValue)->setToolTip(tr("Paired test on the cross-validated error, by blocks"));
  horizontalHeaderItem(qValue)->setToolTip(
      tr("p adjusted for all effects at all places that were looked at together (false discovery rate, Benjamini and "
         "Hochberg 1995): of all that is accepted up to q, a share of q is false on average"));
  horizontalHeaderItem(rank)->setToolTip(
      tr("Rank in the screening, and the share of the excess error that its "
         "sensitivity explains beyond the calibration"));
  horizontalHeader()->setStretchLastSection(true);
}

void EffectsTable::setReport(const GapReport& report) {
  setRowCount(0);
  setRowCount(int(report.tried.size()));
  const Tones tones = tonesOf(palette());
  for (int row = 0; row < rowCount(); ++row) {
    const GapReport::Effect& e = report.tried[std::size_t(row)];
    fillCell(*this, row, effect, word(inWords(e.effect)));
    fillCell(*this, row, at, word(e.at));
    fillCell(*this, row, verdict, e.accepted ? tr("accepted") : tr("rejected"));
    QStringList numbers, others;
    for (const GapReport::Number& n : e.parameters) numbers << word(inWordsWithRivals(n));
    for (const GapReport::Rival& r : e.rivals)
      others << tr("%1 (error × %2)").arg(word(inWords(r)), word(brief(r.heldoutErrorRatio)));
    fillCell(*this, row, parameters, numbers.join("; "))->setToolTip(numbers.join("\n"));
    fillCell(*this, row, gain, word(percent(e.heldoutErrorReduction)), true);
    fillCell(*this, row, pValue, word(brief(e.pValue)), true);
    fillCell(*this, row, qValue, word(brief(e.qValue)), true);
    fillCell(*this, row, rivals, others.join("; "));
    fillCell(*this, row, rank,
             e.screenRank > 0 ? tr("%1 (%2)").arg(e.screenRank).arg(word(percent(e.screenShare))) : tr("–"), true);
    fillCell(*this, row, reason, word(e.reason));
    for (int column = 0; column < columns; ++column) {
      QTableWidgetItem* cell = item(row, column);
      QFont font = cell->font();
      font.setBold(e.accepted && column <= verdict);
      cell->setFont(font);
      if (!e.accepted) cell->setForeground(tones.muted);
      if (e.accepted && column == verdict) cell->setForeground(tones.good);
    }
  }
  // Long lists of numbers do not push the reason out of sight.
  resizeColumnsToContents();
  for (const int wide : {int(reason), int(rivals)})
    if (columnWidth(wide) > 280) {
      horizontalHeader()->setSectionResizeMode(wide, QHeaderView::Interactive);
      setColumnWidth(wide, 280);
    }
}

CalibratedTable::CalibratedTable(QWidget* parent) : QTableWidget(parent) {
  setAccessibleName(tr("Calibrated numbers"));
  setObjectName("calibrated");
  prepare(*this, {tr("Number"), tr("As given"), tr("Fitted"), tr("95 % interval"), tr("Among rivals"), tr("Unit"),
                  tr("Remark")});
  horizontalHeaderItem(interval)->setToolTip(tr("With the accepted effects taken for granted"));
  horizontalHeaderItem(amongRivals)
      ->setToolTip(tr("From end to end of the 95 % interval and of those with each rival (“Cannot be told from”) in "
                      "the place of its effect"));
  horizontalHeader()->setStretchLastSection(true);
}

void CalibratedTable::setReport(const GapReport& report) {
  setRowCount(0);
  setRowCount(int(report.calibrated.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const GapReport::Number& n = report.calibrated[std::size_t(row)];
    fillCell(*this, row, name, word(n.name));
    fillCell(*this, row, before, word(brief(n.before)), true);
    fillCell(*this, row, after, word(brief(n.value)), true);
    fillCell(*this, row, interval, n.ci95.known() ? word(brief(n.ci95)) : tr("–"), true);
    fillCell(*this, row, amongRivals, n.amongRivals.known() ? word(brief(n.amongRivals)) : tr("–"), true);
    fillCell(*this, row, unit, n.unit.empty() ? unitOfPath(n.name) : word(n.unit));
    fillCell(*this, row, remark,
             !n.excited  ? tr("not identifiable from these recordings")
             : n.atBound ? tr("at its bound")
                         : QString());
  }
}

ErrorsTable::ErrorsTable(QWidget* parent) : QTableWidget(parent) {
  setAccessibleName(tr("Errors by channel"));
  setObjectName("errors");
  prepare(*this, {tr("Channel"), tr("Unit"), tr("Noise floor"), tr("As given"), tr("Calibrated"), tr("With effects"),
                  tr("Held out: as given"), tr("Calibrated"), tr("With effects")});
  setToolTip(
      tr("Root mean square of simulated − recorded. The first three are cross-validated: alternate blocks of the "
         "fitted recordings predict each other. Held out: recordings that no fit saw."));
}

void ErrorsTable::setReport(const GapReport& report) {
  setRowCount(0);
  setRowCount(int(report.channels.size()));
  const bool anyHeldOut = unseenError(report).has_value();
  for (int column = heldAsGiven; column <= heldWithEffects; ++column) setColumnHidden(column, !anyHeldOut);
  for (int row = 0; row < rowCount(); ++row) {
    const GapReport::Channel& c = report.channels[std::size_t(row)];
    fillCell(*this, row, channel, word(c.name));
    fillCell(*this, row, unit, word(c.unit));
    int column = floor;
    for (const double error : {c.noiseFloor, c.asGiven, c.calibrated, c.withEffects, c.heldoutAsGiven,
                               c.heldoutCalibrated, c.heldoutWithEffects})
      fillCell(*this, row, column++, word(brief(error)), true);
    if (unseenGotWorse(c.heldoutAsGiven, c.heldoutWithEffects))
      item(row, heldWithEffects)->setForeground(tonesOf(palette()).bad);
  }
}

StepsTable::StepsTable(QWidget* parent) : QTableWidget(parent) {
  setAccessibleName(tr("Error, step by step"));
  setObjectName("steps");
  prepare(*this, {tr("No."), tr("Step"), tr("Error (noise floors)"), tr("Standard error")});
  horizontalHeader()->setStretchLastSection(true);
}

void StepsTable::setReport(const GapReport& report) {
  setRowCount(0);
  setRowCount(int(report.ladder.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const GapReport::Step& one = report.ladder[std::size_t(row)];
    fillCell(*this, row, number, QString::number(row + 1), true);
    fillCell(*this, row, step, word(inWords(one.what)));
    fillCell(*this, row, error, word(brief(one.error)), true);
    fillCell(*this, row, deviation, word(brief(one.standardError)), true);
  }
  resizeColumnsToContents();
}

}  // namespace btr::ui
