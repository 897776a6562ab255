#include "ui/experiment/simulators_page.h"

#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "core/run/reality/adoption.h"
#include "ui/common/database/reading_table.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/experiment/parameter_text.h"

namespace btr::ui {
namespace {

QTableWidget* makeTable(const QString& name, const QStringList& headers, QWidget* parent) {
  auto* table = new QTableWidget(parent);
  table->setObjectName(name);
  setUpForReading(*table, headers);
  table->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  table->horizontalHeaderItem(0)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  return table;
}

QTableWidgetItem* putCell(QTableWidget& table, int row, int column, const QString& text, bool bold = false) {
  auto* item = new QTableWidgetItem(text);
  if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  QFont font = item->font();
  font.setBold(bold);
  item->setFont(font);
  table.setItem(row, column, item);
  return item;
}

QString effectText(const PlacedEffect& effect) {
  QStringList parts;
  for (const auto& [name, value] : effect.parameters)
    parts << QString::fromStdString(name) + " = " + shortNumber(value);
  return QString::fromStdString(effect.effect + " at " + effect.at) +
         (parts.isEmpty() ? QString() : " (" + parts.join(", ") + ")");
}

}  // namespace

SimulatorsPage::SimulatorsPage(QWidget* parent)
    : QWidget(parent),
      versions_(makeTable("versions",
                          {tr("Version"), tr("Made by"), tr("After gen."), tr("Gap before"), tr("Gap after")}, this)),
      difference_(makeTable("difference", {tr("Parameter"), tr("Parent"), tr("This version"), tr("Change")}, this)),
      title_(new QLabel(this)),
      effects_(new QLabel(this)) {
  versions_->setAccessibleName(tr("Simulator versions"));
  difference_->setAccessibleName(tr("Parameters against the parent version"));
  title_->setObjectName("title");
  effects_->setObjectName("effects");
  title_->setContentsMargins(8, 6, 8, 4);
  effects_->setContentsMargins(8, 4, 8, 6);
  title_->setWordWrap(true);
  effects_->setWordWrap(true);
  auto* lower = new QWidget(this);
  auto* column = new QVBoxLayout(lower);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(title_);
  column->addWidget(difference_, 1);
  column->addWidget(effects_);
  auto* splitter = new QSplitter(Qt::Horizontal, this);
  splitter->addWidget(versions_);
  splitter->addWidget(lower);
  splitter->setStretchFactor(0, 4);
  splitter->setStretchFactor(1, 5);
  splitter->setChildrenCollapsible(false);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(splitter);
  connect(versions_, &QTableWidget::currentCellChanged, this, [this] { showDifference(); });
  showDifference();
}

void SimulatorsPage::setSimulators(const std::vector<SimulatorRecord>& simulators) {
  const SimulatorRecord* before = chosen();
  const bool newest = !before || before->id == simulators_.back().id;
  const Id id = before ? before->id : 0;
  simulators_ = simulators;
  showVersions();
  select(newest && !simulators_.empty() ? simulators_.back().id : id);
}

void SimulatorsPage::setGaps(const std::vector<GapRecord>& gaps) {
  gaps_ = gaps;
  const SimulatorRecord* now = chosen();
  const Id id = now ? now->id : 0;
  showVersions();
  select(id);
}

void SimulatorsPage::setUnit(const QString& unit) {
  unit_ = unit;
  setGaps(gaps_);
}

void SimulatorsPage::select(Id simulator) {
  for (std::size_t i = 0; i < simulators_.size(); ++i)
    if (simulators_[i].id == simulator) versions_->setCurrentCell(int(i), 0);
  showDifference();
}

void SimulatorsPage::clear() {
  gaps_.clear();
  setSimulators({});
}

const SimulatorRecord* SimulatorsPage::chosen() const {
  const int row = versions_->currentRow();
  return row >= 0 && row < int(simulators_.size()) ? &simulators_[std::size_t(row)] : nullptr;
}

const SimulatorRecord* SimulatorsPage::byId(Id id) const {
  for (const auto& simulator : simulators_)
    if (simulator.id == id) return &simulator;
  return nullptr;
}

void SimulatorsPage::showVersions() {
  const QSignalBlocker quiet(versions_);
  versions_->setRowCount(int(simulators_.size()));
  for (int row = 0; row < int(simulators_.size()); ++row) {
    const SimulatorRecord& simulator = simulators_[std::size_t(row)];
    const SimulatorRecord* parent = byId(simulator.parent);
    const QString lineage =
        parent ? tr("%1  ← %2").arg(simulator.number).arg(parent->number) : QString::number(simulator.number);
    putCell(*versions_, row, 0, lineage)->setToolTip(tr("Made %1").arg(QString::fromStdString(simulator.createdAt)));
    putCell(*versions_, row, 1, QString::fromStdString(originOf(simulator)));
    putCell(*versions_, row, 2, simulator.rig != 0 ? QString() : QString::number(simulator.madeAfterGeneration));
    QString before, after;
    bool better = false;
    for (const GapRecord& gap : gaps_)
      if (gap.simulatorAfter == simulator.id) {
        before = withUnit(gap.before, unit_);
        after = withUnit(gap.after, unit_);
        better = gap.after < gap.before;
      }
    putCell(*versions_, row, 3, before);
    putCell(*versions_, row, 4, after, better);
  }
}

void SimulatorsPage::showDifference() {
  const SimulatorRecord* simulator = chosen();
  effects_->hide();
  if (!simulator) {
    title_->setText(tr("No simulator version yet."));
    difference_->setRowCount(0);
    return;
  }
  const SimulatorRecord* parent = byId(simulator->parent);
  // A run's first version has all parameters that mean something for its robot, and paths come later.
  const Values& values = simulator->simulator.values;
  const Values& old = parent ? parent->simulator.values : values;

  // The declared parameters in their order, then the paths.
  std::vector<std::pair<QString, std::string>> rows;
  for (const Parameter& parameter : simulatorParameters())
    if (values.count(parameter.name) || old.count(parameter.name))
      rows.push_back({labelOf(parameter) + (parameter.unit.empty()
                                                ? QString()
                                                : QStringLiteral(" [%1]").arg(QString::fromStdString(parameter.unit))),
                      parameter.name});
  Values either = values;
  either.insert(old.begin(), old.end());
  for (const auto& [name, value] : either)
    if (!btr::find(simulatorParameters(), name)) rows.push_back({QString::fromStdString(name), name});

  int changed = 0;
  difference_->setRowCount(int(rows.size()));
  for (int row = 0; row < int(rows.size()); ++row) {
    const auto& [label, name] = rows[std::size_t(row)];
    // A version that does not name a number has that of the scene's file.
    const auto now = values.find(name), before = old.find(name);
    const bool isNew = before == old.end(), isGone = now == values.end();
    const bool differs = isNew || isGone || before->second != now->second;
    const QString given = tr("as given");
    changed += differs;
    putCell(*difference_, row, 0, label, differs)->setToolTip(QString::fromStdString(name));
    putCell(*difference_, row, 1, !parent ? QString() : isNew ? given : shortNumber(before->second));
    QTableWidgetItem* value = putCell(*difference_, row, 2, isGone ? given : shortNumber(now->second), differs);
    if (!isGone) value->setToolTip(QString::fromStdString(btr::toText(now->second)));
    QString change;
    if (differs && !isNew && !isGone && before->second != 0)
      change = QStringLiteral("%1%2 %")
                   .arg(now->second > before->second ? "+" : "−")
                   .arg(std::abs(now->second / before->second - 1) * 100, 0, 'f', 1);
    else if (differs)
      change = isGone ? tr("taken back") : tr("new");
    putCell(*difference_, row, 3, change);
  }
  title_->setText(
      parent
          ? tr("Simulator %1 against its parent %2: %3 changed").arg(simulator->number).arg(parent->number).arg(changed)
      : simulator->rig != 0 ? tr("Simulator %1: the scene as given").arg(simulator->number)
                            : tr("Simulator %1, with which the run began").arg(simulator->number));
  if (simulator->simulator.effects.empty()) return;
  QStringList effects;
  for (const auto& effect : simulator->simulator.effects) {
    const auto& known = parent ? parent->simulator.effects : simulator->simulator.effects;
    const bool isNew = std::find(known.begin(), known.end(), effect) == known.end();
    const QString text = effectText(effect).toHtmlEscaped();
    effects << (isNew ? "<b>" + text + "</b>" : text);
  }
  effects_->setText(tr("Added effects: ") + effects.join(", "));
  effects_->show();
}

}  // namespace btr::ui
