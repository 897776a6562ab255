#include "ui/live/panels/signal_picker.h"

#include <QLineEdit>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>

#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {

QTreeWidgetItem* childOf(QTreeWidgetItem* parent, const QString& name) {
  for (int i = 0; i < parent->childCount(); ++i)
    if (parent->child(i)->text(0) == name && parent->child(i)->data(0, Qt::UserRole).isNull()) return parent->child(i);
  return new QTreeWidgetItem(parent, {name});
}

void visitSignals(QTreeWidgetItem* item, const std::function<void(QTreeWidgetItem*)>& each) {
  if (!item->data(0, Qt::UserRole).isNull()) each(item);
  for (int i = 0; i < item->childCount(); ++i) visitSignals(item->child(i), each);
}

/// Whether anything in it is shown.
bool showWhat(QTreeWidgetItem* item, const QString& text) {
  bool any = item->childCount() == 0 && item->data(0, Qt::UserRole).toString().contains(text, Qt::CaseInsensitive);
  for (int i = 0; i < item->childCount(); ++i) any = showWhat(item->child(i), text) || any;
  item->setHidden(!any);
  if (item->childCount() > 0) item->setExpanded(any && !text.isEmpty());
  return any;
}

}  // namespace

SignalPicker::SignalPicker(QWidget* parent)
    : QWidget(parent), search_(new QLineEdit(this)), tree_(new QTreeWidget(this)) {
  search_->setObjectName("liveSignalSearch");
  search_->setPlaceholderText(tr("Find a signal"));
  search_->setAccessibleName(tr("Find a signal"));
  search_->setToolTip(tr("A part of its name: torque, LF_J1, ball …"));
  search_->setClearButtonEnabled(true);
  search_->addAction(themeIcon("search"), QLineEdit::LeadingPosition);
  connect(search_, &QLineEdit::textChanged, this, &SignalPicker::filter);
  tree_->setObjectName("liveSignals");
  tree_->setAccessibleName(tr("Signals"));
  tree_->setHeaderHidden(true);
  tree_->setToolTip(tr("At most %1 at once").arg(most));
  connect(tree_, &QTreeWidget::itemChanged, this, &SignalPicker::check);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(search_);
  column->addWidget(tree_, 1);
}

const Signal* SignalPicker::find(const std::string& name) const {
  const auto found = std::ranges::find(all_, name, &Signal::name);
  if (found != all_.end()) return &*found;
  const auto gone = std::ranges::find(chosen_, name, &Signal::name);
  return gone == chosen_.end() ? nullptr : &*gone;
}

bool SignalPicker::isGone(const Signal& signal) const { return std::ranges::find(all_, signal) == all_.end(); }

void SignalPicker::setSignals(std::vector<Signal> wanted, bool keepGone) {
  const bool same = wanted == all_;
  all_ = std::move(wanted);
  const std::size_t before = chosen_.size();
  if (!keepGone) std::erase_if(chosen_, [this](const Signal& signal) { return isGone(signal); });
  if (same && chosen_.size() == before) return;
  fill();
  if (chosen_.size() != before) emit chosenChanged();
}

void SignalPicker::fill() {
  const QSignalBlocker quiet(tree_);
  tree_->clear();
  std::vector<Signal> shown = all_;
  for (const Signal& signal : chosen_)
    if (isGone(signal)) shown.push_back(signal);
  for (const Signal& signal : shown) {
    // Object, then joint or part, then quantity.
    QStringList parts = word(signal.name).split('.');
    QTreeWidgetItem* parent = tree_->invisibleRootItem();
    for (int i = 0; i + 1 < parts.size(); ++i) parent = childOf(parent, parts[i]);
    auto* item = new QTreeWidgetItem(parent, {parts.back()});
    item->setData(0, Qt::UserRole, word(signal.name));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(0, std::ranges::find(chosen_, signal) == chosen_.end() ? Qt::Unchecked : Qt::Checked);
    if (isGone(signal)) {
      item->setToolTip(0, tr("What it belongs to is gone; its plot goes on when that comes back"));
      item->setForeground(0, palette().brush(QPalette::Disabled, QPalette::Text));
    } else if (const std::string unit = unitOfSignal(signal.name); !unit.empty()) {
      item->setToolTip(0, tr("in %1").arg(word(unit)));
    }
  }
  filter(search_->text());
}

void SignalPicker::filter(const QString& text) {
  for (int i = 0; i < tree_->topLevelItemCount(); ++i) showWhat(tree_->topLevelItem(i), text.trimmed());
}

bool SignalPicker::choose(const std::string& name, bool on) {
  const Signal* known = find(name);
  if (!known) return false;
  const Signal signal = *known;  // it may be one of those that are erased below
  const auto found = std::ranges::find(chosen_, signal);
  if (on == (found != chosen_.end())) return true;
  if (on && chosen_.size() >= most) return false;
  if (on)
    chosen_.push_back(signal);
  else
    chosen_.erase(found);
  const QSignalBlocker quiet(tree_);
  visitSignals(tree_->invisibleRootItem(), [&](QTreeWidgetItem* item) {
    if (item->data(0, Qt::UserRole).toString() == word(name)) item->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
  });
  emit chosenChanged();
  return true;
}

void SignalPicker::check(QTreeWidgetItem* item) {
  if (item->data(0, Qt::UserRole).isNull()) return;
  const bool on = item->checkState(0) == Qt::Checked;
  if (choose(item->data(0, Qt::UserRole).toString().toStdString(), on)) return;
  const QSignalBlocker quiet(tree_);
  item->setCheckState(0, Qt::Unchecked);
  emit tooMany();
}

}  // namespace btr::ui
