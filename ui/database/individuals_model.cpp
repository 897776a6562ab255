#include "ui/database/individuals_model.h"

#include <QGuiApplication>

#include "core/sim/trial.h"
#include "core/spec/figures.h"
#include "ui/charts/plot_data.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {

IndividualsModel::IndividualsModel(QObject* parent) : QAbstractTableModel(parent) {}

void IndividualsModel::setUnit(const QString& unit) {
  unit_ = unit;
  emit headerDataChanged(Qt::Horizontal, 0, columns - 1);
}

void IndividualsModel::setStandIn(bool standIn) {
  standIn_ = standIn;
  emit headerDataChanged(Qt::Horizontal, 0, columns - 1);
}

void IndividualsModel::setSimulators(const std::vector<SimulatorRecord>& simulators) {
  simulators_.clear();
  for (const SimulatorRecord& record : simulators) simulators_[record.id] = record.number;
  if (!individuals_.empty()) emit dataChanged(index(0, simulator), index(rowCount() - 1, simulator));
}

void IndividualsModel::setMeasurements(const std::vector<MeasurementRecord>& measurements) {
  measured_.clear();
  for (const MeasurementRecord& record : measurements) {
    Measured& entry = measured_[record.individual];
    if (record.isVoid)
      ++entry.voids;
    else
      entry.values.push_back(record.value);
  }
  for (auto& [id, entry] : measured_) entry.spread = spreadOf(entry.values);
  if (!individuals_.empty()) emit dataChanged(index(0, measuredMean), index(rowCount() - 1, voidCount));
}

void IndividualsModel::setHidden(const std::set<Id>& hidden) {
  if (hidden == hidden_) return;
  hidden_ = hidden;
  if (!individuals_.empty()) emit dataChanged(index(0, fitness), index(rowCount() - 1, fitness));
}

void IndividualsModel::clear() {
  beginResetModel();
  individuals_.clear();
  rows_.clear();
  endResetModel();
}

void IndividualsModel::append(const std::vector<IndividualRecord>& individuals) {
  std::vector<IndividualRecord> fresh;
  for (const IndividualRecord& individual : individuals)
    if (rows_.emplace(individual.id, rowCount() + static_cast<int>(fresh.size())).second) fresh.push_back(individual);
  if (fresh.empty()) return;
  beginInsertRows({}, rowCount(), rowCount() + static_cast<int>(fresh.size()) - 1);
  individuals_.insert(individuals_.end(), std::make_move_iterator(fresh.begin()), std::make_move_iterator(fresh.end()));
  endInsertRows();
}

int IndividualsModel::rowOf(Id individual) const {
  const auto found = rows_.find(individual);
  return found == rows_.end() ? -1 : found->second;
}

const IndividualsModel::Measured* IndividualsModel::measured(int row) const {
  const auto found = measured_.find(at(row).id);
  return found == measured_.end() ? nullptr : &found->second;
}

const Spread* IndividualsModel::measuredAt(int row) const {
  const Measured* entry = measured(row);
  return entry && entry->spread.count > 0 ? &entry->spread : nullptr;
}

int IndividualsModel::simulatorNumber(Id id) const {
  const auto found = simulators_.find(id);
  return found == simulators_.end() ? -1 : found->second;
}

QStringList IndividualsModel::csvColumns(const QString& unit) {
  return {"individual",
          "generation",
          "slot",
          columnName("fitness", unit),
          "outcome",
          "simulator",
          "same_as_individual",
          columnName("measured_mean", unit),
          columnName("measured_sd", unit),
          "measured_count",
          "void_count",
          "reality",
          "chromosome"};
}

QString IndividualsModel::toCsv(const std::vector<int>& rows) const {
  QString text = csvColumns(unit_).join(',') + '\n';
  for (const int row : rows) {
    const IndividualRecord& r = at(row);
    const Measured* entry = measured(row);
    const Spread* spread = measuredAt(row);
    const int version = simulatorNumber(r.simulator);
    text += QStringList{QString::number(r.id),
                        QString::number(r.generation),
                        QString::number(r.slot),
                        isHidden(r) ? QString() : exactText(r.fitness),
                        QString::fromStdString(r.outcome),
                        version < 0 ? QString() : QString::number(version),
                        r.sameAs ? QString::number(r.sameAs) : QString(),
                        spread ? exactText(spread->mean) : QString(),
                        spread && spread->count > 1 ? exactText(spread->deviation) : QString(),
                        QString::number(spread ? spread->count : 0),
                        QString::number(entry ? entry->voids : 0),
                        !entry     ? QString()
                        : standIn_ ? QString("stand_in")
                                   : QString("person"),
                        QString::fromStdString(r.chromosome)}
                .join(',') +
            '\n';
  }
  return text;
}

int IndividualsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(individuals_.size());
}

int IndividualsModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : columns; }

QVariant IndividualsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  const QString real = standIn_ ? tr("stand-in") : tr("measured");
  if (role == Qt::DisplayRole) switch (section) {
      case number:
        return tr("individual");
      case generation:
        return tr("generation");
      case slot:
        return tr("slot");
      case fitness:
        return axisTitle(tr("fitness"), unit_);
      case outcome:
        return tr("outcome");
      case simulator:
        return tr("simulator");
      case sameAs:
        return tr("same as");
      case measuredMean:
        return axisTitle(tr("%1 mean").arg(real), unit_);
      case measuredDeviation:
        return axisTitle(tr("± sd"), unit_);
      case measuredCount:
        return tr("n");
      case voidCount:
        return tr("void");
    }
  if (role == Qt::ToolTipRole) switch (section) {
      case slot:
        return tr("Place in the population");
      case number:
        return tr("Its number in the database, as on the measurement sheet");
      case fitness:
        return tr("Fitness in the simulator; hidden of those that wait to be measured");
      case outcome:
        return tr("How the simulated trial ended");
      case simulator:
        return tr("Version of the simulator");
      case sameAs:
        return tr("Not simulated again: the earlier individual with this chromosome");
      case measuredMean:
        return standIn_ ? tr("Mean of the values that the stand-in reality answered, without void ones")
                        : tr("Mean of the measured values, without void ones");
      case measuredDeviation:
        return tr("Standard deviation of the repeats");
      case measuredCount:
        return tr("Number of repeats that count");
      case voidCount:
        return tr("Number of void values");
    }
  return {};
}

QVariant IndividualsModel::valueAt(int row, int column) const {
  const IndividualRecord& r = at(row);
  const Spread* spread = column >= measuredMean ? measuredAt(row) : nullptr;
  switch (column) {
    case number:
      return static_cast<qlonglong>(r.id);
    case generation:
      return r.generation;
    case slot:
      return r.slot;
    case fitness:
      return isHidden(r) ? QVariant() : QVariant(r.fitness);
    case outcome:
      return QString::fromStdString(r.outcome);
    case simulator:
      return simulatorNumber(r.simulator);
    case sameAs:
      return r.sameAs ? QVariant(static_cast<qlonglong>(r.sameAs)) : QVariant();
    case measuredMean:
      return spread ? QVariant(spread->mean) : QVariant();
    case measuredDeviation:
      return spread && spread->count > 1 ? QVariant(spread->deviation) : QVariant();
    case measuredCount:
      return spread ? QVariant(spread->count) : QVariant();
    case voidCount: {
      const Measured* entry = measured(row);
      return entry && entry->voids > 0 ? QVariant(entry->voids) : QVariant();
    }
  }
  return {};
}

QVariant IndividualsModel::textAt(int row, int column) const {
  const QVariant value = valueAt(row, column);
  if (column == fitness && !value.isValid()) return tr("hidden");
  if (column == simulator && value.toInt() < 0) return tr("?");
  if (column == measuredDeviation && value.isValid()) return forPeople(digits(value.toDouble(), 2));
  if (value.typeId() == QMetaType::Double) return shortNumber(value.toDouble());
  return value;
}

QVariant IndividualsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const int column = index.column();
  const IndividualRecord& record = at(index.row());
  switch (role) {
    case Qt::DisplayRole:
      return textAt(index.row(), column);
    case SortRole:
      return valueAt(index.row(), column);
    case Qt::TextAlignmentRole:
      return QVariant(column == outcome ? Qt::AlignLeft | Qt::AlignVCenter : Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ToolTipRole:
      if (column == outcome && !record.detail.empty() && !isHidden(record))
        return QString::fromStdString(record.detail);
      if (column == fitness || column == measuredMean || column == measuredDeviation) {
        const QVariant value = valueAt(index.row(), column);
        if (value.isValid()) return exactText(value.toDouble()) + (unit_.isEmpty() ? QString() : ' ' + unit_);
      }
      return {};
    case Qt::ForegroundRole: {
      const Tones tones = tonesOf(QGuiApplication::palette());
      if (column == outcome && !isFinished(record.outcome)) return tones.bad;
      if (column >= measuredMean && standIn_) return tones.standIn;
      // Not simulated again: quieter than the individual that it repeats.
      if (record.sameAs) return tones.muted;
      return {};
    }
    default:
      return {};
  }
}

}  // namespace btr::ui
