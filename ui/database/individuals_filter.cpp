#include "ui/database/individuals_filter.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace btr::ui {

IndividualsFilter::IndividualsFilter(IndividualsModel& model, QObject* parent)
    : QSortFilterProxyModel(parent), model_(model) {
  setSourceModel(&model);
  setDynamicSortFilter(true);
  connect(&model, &QAbstractItemModel::rowsInserted, this, [this] {
    if (bestDistinct_) setBestDistinct(true);
  });
  connect(&model, &QAbstractItemModel::modelReset, this, [this] { best_.clear(); });
}

void IndividualsFilter::setGenerations(int from, int to) {
  from_ = from;
  to_ = to;
  invalidateFilter();
}

void IndividualsFilter::setMeasuredOnly(bool on) {
  measuredOnly_ = on;
  invalidateFilter();
}

void IndividualsFilter::setBestDistinct(bool on) {
  bestDistinct_ = on;
  findBest();
  invalidateFilter();
}

void IndividualsFilter::setWords(const QString& words) {
  words_ = words.split(' ', Qt::SkipEmptyParts);
  invalidateFilter();
}

const IndividualRecord& IndividualsFilter::recordAt(const QModelIndex& proxyIndex) const {
  return model_.at(mapToSource(proxyIndex).row());
}

void IndividualsFilter::findBest() {
  best_.clear();
  if (!bestDistinct_) return;
  const auto better = [](const IndividualRecord& a, const IndividualRecord& b) {
    if (a.fitness != b.fitness) return a.fitness > b.fitness;
    return std::pair(a.generation, a.slot) < std::pair(b.generation, b.slot);
  };
  std::unordered_map<std::string, const IndividualRecord*> best;
  for (int row = 0; row < model_.rowCount(); ++row) {
    const IndividualRecord& record = model_.at(row);
    const auto [place, fresh] = best.emplace(identityOf(record), &record);
    if (!fresh && better(record, *place->second)) place->second = &record;
  }
  for (const auto& [identity, record] : best) best_.insert(record->id);
}

bool IndividualsFilter::filterAcceptsRow(int row, const QModelIndex&) const {
  const IndividualRecord& record = model_.at(row);
  if (from_ > 0 && record.generation < from_) return false;
  if (to_ > 0 && record.generation > to_) return false;
  if (measuredOnly_ && !model_.measuredAt(row)) return false;
  if (bestDistinct_ && !best_.contains(record.id)) return false;
  return std::all_of(words_.begin(), words_.end(), [&](const QString& word) {
    return QString::number(record.id) == word ||
           QString::fromStdString(record.outcome).contains(word, Qt::CaseInsensitive) ||
           (!model_.isHidden(record) && QString::fromStdString(record.detail).contains(word, Qt::CaseInsensitive)) ||
           QString::fromStdString(record.chromosome).startsWith(word);
  });
}

bool IndividualsFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  const IndividualRecord &a = model_.at(left.row()), &b = model_.at(right.row());
  const bool descending = sortOrder() == Qt::DescendingOrder;
  // Of equal ones the earlier comes first, whichever way is sorted.
  const auto earlier = [&] {
    const std::pair x(a.generation, a.slot), y(b.generation, b.slot);
    return descending ? y < x : x < y;
  };
  switch (left.column()) {
    case IndividualsModel::generation:
      return std::pair(a.generation, a.slot) < std::pair(b.generation, b.slot);
    case IndividualsModel::slot:
      return a.slot != b.slot ? a.slot < b.slot : a.generation < b.generation;
    case IndividualsModel::outcome:
      return a.outcome != b.outcome ? a.outcome < b.outcome : earlier();
    case IndividualsModel::number:
      return a.id < b.id;
    case IndividualsModel::fitness:
      // Where one stands would tell what is hidden.
      if (const bool x = model_.isHidden(a), y = model_.isHidden(b); x || y)
        return x && y ? earlier() : descending ? x : y;
      return a.fitness != b.fitness ? a.fitness < b.fitness : earlier();
    default:
      break;
  }
  const QVariant x = left.data(IndividualsModel::SortRole), y = right.data(IndividualsModel::SortRole);
  if (x.isValid() != y.isValid()) return descending ? y.isValid() : x.isValid();
  if (x.toDouble() != y.toDouble()) return x.toDouble() < y.toDouble();
  return earlier();
}

}  // namespace btr::ui
