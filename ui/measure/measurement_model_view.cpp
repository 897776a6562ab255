// What a MeasurementModel answers to its view.
#include <QFont>
#include <QGuiApplication>
#include <QLocale>
#include <QPalette>

#include "core/run/reality/reality_gap.h"
#include "core/run/reality/spread.h"
#include "core/spec/figures.h"
#include "ui/charts/plot_data.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/measure/measurement_model.h"

namespace btr::ui {

int MeasurementModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int MeasurementModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : replayColumn() + 1; }

QVariant MeasurementModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::DisplayRole) {
    if (section == positionColumn) return tr("order");
    if (section == individualColumn) return tr("individual");
    if (section == simulatedColumn) return axisTitle(tr("simulated"), unit_);
    if (isRepeat(section))
      return repeats_ == 1 ? axisTitle(tr("measured"), unit_)
                           : axisTitle(tr("repeat %1").arg(section - firstRepeat + 1), unit_);
    if (section == meanColumn()) return axisTitle(tr("mean ± sd"), unit_);
    if (section == countColumn()) return tr("n");
    if (section == voidColumn()) return tr("void");
    if (section == reasonColumn()) return tr("chosen as");
    if (section == noteColumn()) return tr("note");
    if (section == replayColumn()) return tr("replay");
  }
  if (role == Qt::ToolTipRole) {
    if (section == reasonColumn())
      return tr(
          "Why it is measured: among the best, or candidate simulators disagree about it, so that its real fitness "
          "tells them apart. Numbers are shown with the simulated fitness.");
    if (section == positionColumn) return tr("Measure in this order: it was drawn at random");
    if (section == simulatedColumn) return tr("Fitness in the simulator version of that time");
    if (isRepeat(section)) return tr("Real fitness: %1").arg(allowed_.text(unit_));
    if (section == meanColumn()) return tr("Mean ± standard deviation of the repeats that are not void");
    if (section == countColumn()) return tr("Number of repeats that count");
    if (section == voidColumn())
      return tr(
          "The whole row: it fell or could not be measured. Counts as done, but in no mean. One value alone becomes "
          "void "
          "by its menu (right click), or by typing “void”.");
  }
  return {};
}

QVariant MeasurementModel::textAt(const MeasurementRow& row, int column) const {
  if (column == positionColumn) return row.task.position;
  if (column == individualColumn) return static_cast<qlonglong>(row.task.individual);
  if (column == simulatedColumn)
    return isSimulatedVisible() ? QVariant(shortNumber(row.task.simulatedFitness)) : QVariant();
  if (isRepeat(column)) {
    const auto place = static_cast<std::size_t>(column - firstRepeat);
    if (place < row.saved.size()) return exactText(row.saved[place].value);
    const auto unsaved = place - row.saved.size();
    return unsaved < row.edit.values.size() ? row.edit.values[unsaved].text : QString();
  }
  const std::vector<double> values = row.values();
  if (column == meanColumn()) {
    if (values.empty()) return row.edit.isVoid || row.state() == MeasurementRow::State::isVoid ? tr("void") : QString();
    const Spread spread = spreadOf(values);
    return spread.count > 1 ? forPeople(withDeviation(spread.mean, spread.deviation)) : shortNumber(spread.mean);
  }
  if (column == countColumn()) return static_cast<int>(values.size());
  if (column == reasonColumn())
    return QString::fromStdString(reasonOf(row.task, unit_.toStdString(), isSimulatedVisible()));
  if (column == noteColumn()) {
    if (!row.edit.note.isEmpty()) return row.edit.note;
    QStringList notes;
    for (const MeasurementRecord& record : row.saved)
      if (const QString note = QString::fromStdString(record.note); !note.isEmpty() && !notes.contains(note))
        notes << note;
    return notes.join("; ");
  }
  return {};
}

// Stored numbers may be long: exact in the tip and when copied, short in the cell. A void trial without a number has
// none to show: it is stored as 0.
QVariant MeasurementModel::shownAt(const QModelIndex& index) const {
  if (const MeasurementRecord* saved = savedAt(index))
    return saved->isVoid && saved->value == 0 ? tr("void") : QLocale::c().toString(saved->value, 'g', 6);
  const QVariant text = textAt(rows_[static_cast<std::size_t>(index.row())], index.column());
  return isValueVoid(index) && text.toString().isEmpty() ? tr("void") : text;
}

QVariant MeasurementModel::toolTipAt(const QModelIndex& index) const {
  if (const QString text = problem(index.row(), index.column()); !text.isEmpty()) return text;
  if (const MeasurementRecord* saved = savedAt(index)) {
    const QString value = saved->isVoid && saved->value == 0 ? tr("no number (or 0)") : exactText(saved->value);
    QString text = tr("%1, saved %2").arg(value, QString::fromStdString(saved->enteredAt));
    if (!saved->who.empty()) text += tr(" by %1").arg(QString::fromStdString(saved->who));
    if (saved->source == "stand_in") text += tr(", answered by the stand-in reality");
    if (!saved->note.empty()) text += '\n' + QString::fromStdString(saved->note);
    return text + '\n' +
           (saved->isVoid ? tr("Void: counts in no mean.") : tr("To correct it, void it and enter a further repeat."));
  }
  if (isRepeat(index.column())) return tr("Allowed is %1").arg(allowed_.text(unit_));
  return {};
}

QVariant MeasurementModel::colourAt(const QModelIndex& index, int role) const {
  const Tones tones = tonesOf(QGuiApplication::palette());
  const MeasurementRow& row = rows_[static_cast<std::size_t>(index.row())];
  const MeasurementRecord* saved = savedAt(index);
  if (role == Qt::BackgroundRole) {
    QColor colour;
    if (!problem(index.row(), index.column()).isEmpty()) {
      colour = tones.bad;
      colour.setAlpha(90);
    } else if (isRepeat(index.column()) && !saved && !shownAt(index).toString().isEmpty()) {
      colour = tones.accent;
      colour.setAlpha(38);
    }
    return colour.isValid() ? QVariant(colour) : QVariant();
  }
  if ((saved && saved->isVoid) || isValueVoid(index) || (row.edit.isVoid && isRepeat(index.column())))
    return tones.muted;
  if (index.column() == positionColumn || index.column() == individualColumn) return tones.muted;
  if (saved && saved->source == "stand_in") return tones.standIn;
  if (index.column() == meanColumn() && row.state() == MeasurementRow::State::measured) return tones.good;
  return {};
}

QVariant MeasurementModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const int column = index.column();
  const MeasurementRow& row = rows_[static_cast<std::size_t>(index.row())];
  switch (role) {
    case Qt::DisplayRole:
      return shownAt(index);
    case Qt::EditRole:
      return textAt(row, column);
    case Qt::CheckStateRole:
      if (column != voidColumn()) return {};
      return row.edit.isVoid || row.state() == MeasurementRow::State::isVoid ? Qt::Checked : Qt::Unchecked;
    case Qt::ToolTipRole:
      return toolTipAt(index);
    case Qt::BackgroundRole:
    case Qt::ForegroundRole:
      return colourAt(index, role);
    case Qt::FontRole: {
      QFont font;
      const MeasurementRecord* saved = savedAt(index);
      if (!isRepeat(column) || !(row.edit.isVoid || isValueVoid(index) || (saved && saved->isVoid))) return {};
      font.setStrikeOut(shownAt(index) != tr("void"));
      return font;
    }
    case Qt::TextAlignmentRole:
      return QVariant(column == noteColumn() || column == reasonColumn() ? Qt::AlignLeft | Qt::AlignVCenter
                                                                         : Qt::AlignRight | Qt::AlignVCenter);
    case Qt::AccessibleTextRole:
      return headerData(column, Qt::Horizontal, Qt::DisplayRole).toString() + ' ' + shownAt(index).toString();
    default:
      return {};
  }
}

Qt::ItemFlags MeasurementModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return Qt::NoItemFlags;
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  if ((isRepeat(index.column()) && !savedAt(index)) || index.column() == noteColumn()) flags |= Qt::ItemIsEditable;
  const bool isVoid = rows_[static_cast<std::size_t>(index.row())].state() == MeasurementRow::State::isVoid;
  if (index.column() == voidColumn() && !isVoid) flags |= Qt::ItemIsUserCheckable;
  return flags;
}

bool MeasurementModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid()) return false;
  if (role == Qt::CheckStateRole && (flags(index) & Qt::ItemIsUserCheckable)) {
    setVoid(index.row(), value.toInt() == Qt::Checked);
    return true;
  }
  if (role != Qt::EditRole || !(flags(index) & Qt::ItemIsEditable)) return false;
  // A note that is only shown again is no edit.
  if (value.toString() != data(index, Qt::EditRole).toString())
    write({{index.row(), index.column(), value.toString()}}, tr("entry"));
  return true;
}

}  // namespace btr::ui
