#include "ui/database/individuals_table.h"

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QSaveFile>
#include <QSpinBox>
#include <QSplitter>
#include <QTableView>
#include <QToolButton>
#include <algorithm>

#include "ui/common/look/short_label.h"
#include "ui/common/look/theme.h"
#include "ui/database/individual_details.h"

namespace btr::ui {

IndividualsTable::IndividualsTable(QWidget* parent)
    : QWidget(parent), filter_(model_), view_(new QTableView(this)), details_(new IndividualDetails(this)) {
  view_->setModel(&filter_);
  view_->setSortingEnabled(true);
  view_->sortByColumn(IndividualsModel::generation, Qt::AscendingOrder);
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setAlternatingRowColors(true);
  view_->setWordWrap(false);
  view_->verticalHeader()->hide();
  view_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  view_->horizontalHeader()->setHighlightSections(false);
  view_->horizontalHeader()->setStretchLastSection(true);
  view_->setContextMenuPolicy(Qt::CustomContextMenu);
  view_->setAccessibleName(tr("Individuals"));
  view_->installEventFilter(this);

  auto* splitter = new QSplitter(this);
  splitter->addWidget(view_);
  splitter->addWidget(details_);
  splitter->setStretchFactor(0, 3);
  splitter->setStretchFactor(1, 2);
  splitter->setSizes({780, 400});
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(makeFilterBar());
  layout->addWidget(splitter, 1);
  setFocusProxy(view_);

  fitColumns();
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &IndividualsTable::showSelected);
  connect(view_, &QTableView::doubleClicked, this,
          [this](const QModelIndex& index) { emit replayRequested(filter_.recordAt(index).id); });
  connect(view_, &QWidget::customContextMenuRequested, this, &IndividualsTable::showMenu);
  // With two individuals selected, both are meant.
  connect(details_, &IndividualDetails::replayRequested, this, [this](Id individual) {
    if (const std::vector<Id> pair = selectedAll(); pair.size() == 2)
      emit pairRequested(pair[0], pair[1]);
    else
      emit replayRequested(individual);
  });
  for (const auto signal : {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved})
    connect(&filter_, signal, this, &IndividualsTable::showCount);
  connect(&filter_, &QAbstractItemModel::modelReset, this, &IndividualsTable::showCount);
  showCount();
}

void IndividualsTable::fitColumns() {
  // Title, sort arrow and margins; numbers of four digits always fit.
  for (int column = 0; column < IndividualsModel::columns; ++column) {
    const QString header = model_.headerData(column, Qt::Horizontal).toString();
    const QString widest = column == IndividualsModel::measuredDeviation ? QString("0.001234") : header;
    const int text = std::max(fontMetrics().horizontalAdvance(header), fontMetrics().horizontalAdvance(widest));
    view_->setColumnWidth(column, std::max(52, text + 32));
  }
}

QWidget* IndividualsTable::makeFilterBar() {
  auto* bar = new QWidget(this);
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(0, 0, 0, 0);
  const auto generationBox = [&](const QString& open) {
    auto* box = new QSpinBox(bar);
    box->setRange(0, 1000000);
    box->setSpecialValueText(open);
    connect(box, &QSpinBox::valueChanged, this, [this] {
      filter_.setGenerations(from_->value(), to_->value());
      showCount();
    });
    return box;
  };
  layout->addWidget(new QLabel(tr("Generations"), bar));
  from_ = generationBox(tr("first"));
  to_ = generationBox(tr("last"));
  layout->addWidget(from_);
  layout->addWidget(new QLabel(tr("to"), bar));
  layout->addWidget(to_);
  distinct_ = new QCheckBox(tr("Best distinct"), bar);
  distinct_->setToolTip(tr("Each chromosome once, best first"));
  connect(distinct_, &QCheckBox::toggled, this, [this](bool on) {
    filter_.setBestDistinct(on);
    if (on) view_->sortByColumn(IndividualsModel::fitness, Qt::DescendingOrder);
    showCount();
  });
  measured_ = new QCheckBox(tr("Measured"), bar);
  measured_->setToolTip(tr("Only individuals with real fitness"));
  connect(measured_, &QCheckBox::toggled, this, [this](bool on) {
    filter_.setMeasuredOnly(on);
    showCount();
  });
  words_ = new QLineEdit(bar);
  words_->setPlaceholderText(tr("Number, outcome or chromosome…"));
  words_->setClearButtonEnabled(true);
  words_->setMinimumWidth(100);
  words_->setMaximumWidth(240);
  connect(words_, &QLineEdit::textChanged, this, [this](const QString& text) {
    filter_.setWords(text);
    showCount();
  });
  count_ = new ShortLabel(bar);
  count_->setObjectName("individualsCount");
  auto* save = new QToolButton(bar);
  save->setIcon(themeIcon("document-export"));
  save->setText(tr("CSV…"));
  save->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  save->setAutoRaise(true);
  save->setToolTip(tr("Save the rows shown (or those selected) as CSV"));
  connect(save, &QToolButton::clicked, this, &IndividualsTable::exportCsv);
  layout->addSpacing(6);
  layout->addWidget(distinct_);
  layout->addWidget(measured_);
  layout->addWidget(words_, 3);
  layout->addStretch(1);
  layout->addWidget(count_);
  layout->addWidget(save);
  return bar;
}

void IndividualsTable::setUnit(const QString& unit) {
  model_.setUnit(unit);
  details_->setUnit(unit);
  fitColumns();
}

void IndividualsTable::setStandIn(bool standIn) {
  model_.setStandIn(standIn);
  fitColumns();
}
void IndividualsTable::setGenotype(const std::vector<Parameter>& genotype) { details_->setGenotype(genotype); }
void IndividualsTable::setSimulators(const std::vector<SimulatorRecord>& simulators) {
  model_.setSimulators(simulators);
}

void IndividualsTable::setMeasurements(const std::vector<MeasurementRecord>& measurements) {
  model_.setMeasurements(measurements);
  showCount();
}

void IndividualsTable::setHidden(const std::set<Id>& hidden) {
  model_.setHidden(hidden);
  if (details_->individual() != 0) showSelected();
}

void IndividualsTable::load(int last, Reader read) {
  clear();
  read_ = std::move(read);
  last_ = last;
  readPage();
}

void IndividualsTable::extend(int last) {
  last_ = std::max(last_, last);
  if (!reading_ && read_ && trouble_.isEmpty()) readPage();
}

void IndividualsTable::readPage() {
  reading_ = true;
  showCount();
  if (next_ > last_) return end({});
  read_(
      next_, last_,
      [this, load = load_](const Page& page) {
        if (load == load_) takePage(page);
      },
      [this, load = load_](const QString& why) {
        if (load == load_) end(why);
      });
}

void IndividualsTable::takePage(const Page& page) {
  model_.append(page.individuals);
  next_ = page.next;
  if (next_ > last_) return end({});
  readPage();
}

void IndividualsTable::end(const QString& trouble) {
  reading_ = false;
  trouble_ = trouble;
  showCount();
  emit loaded();
}

void IndividualsTable::clear() {
  ++load_;
  read_ = {};
  reading_ = false;
  next_ = 1;
  last_ = 0;
  trouble_.clear();
  model_.clear();
  details_->clear();
  showCount();
}

bool IndividualsTable::select(Id individual) {
  const int row = model_.rowOf(individual);
  const QModelIndex index = row < 0 ? QModelIndex() : filter_.mapFromSource(model_.index(row, 0));
  if (!index.isValid()) return false;
  view_->selectRow(index.row());
  view_->scrollTo(index);
  return true;
}

Id IndividualsTable::selected() const { return details_->individual(); }

std::vector<Id> IndividualsTable::selectedAll() const {
  std::vector<Id> all;
  for (const QModelIndex& row : view_->selectionModel()->selectedRows()) all.push_back(filter_.recordAt(row).id);
  return all;
}

void IndividualsTable::showSelected() {
  const QModelIndexList rows = view_->selectionModel()->selectedRows();
  if (rows.isEmpty()) return details_->clear();
  const IndividualRecord& record =
      filter_.recordAt(rows.contains(view_->currentIndex().siblingAtColumn(0)) ? view_->currentIndex() : rows.front());
  details_->setIndividual(record, model_.simulatorNumber(record.simulator), model_.isHidden(record));
  emit selectionChanged(record.id);
}

void IndividualsTable::showCount() {
  const int shown = filter_.rowCount(), all = model_.rowCount();
  QString brief = QString::number(shown);
  QString whole = shown == all ? tr("%1 individuals").arg(all) : tr("%1 of %2 individuals").arg(shown).arg(all);
  if (reading_) {
    whole += tr(", reading…");
    brief += QStringLiteral("…");
  }
  if (!trouble_.isEmpty())
    count_->setTexts(trouble_, tr("Not read"));
  else
    count_->setTexts(whole, brief);
}

QString IndividualsTable::csv() const {
  std::vector<int> rows;
  const QModelIndexList selected = view_->selectionModel()->selectedRows();
  if (selected.size() > 1)
    for (const QModelIndex& index : selected) rows.push_back(index.row());
  else
    for (int row = 0; row < filter_.rowCount(); ++row) rows.push_back(row);
  // As they stand on the screen.
  std::sort(rows.begin(), rows.end());
  for (int& row : rows) row = filter_.mapToSource(filter_.index(row, 0)).row();
  return model_.toCsv(rows);
}

void IndividualsTable::copyCsv() const { QApplication::clipboard()->setText(csv()); }

void IndividualsTable::exportCsv() {
  const QString path =
      QFileDialog::getSaveFileName(this, tr("Save individuals"), "individuals.csv", tr("Numbers (*.csv)"));
  if (path.isEmpty()) return;
  const QByteArray bytes = csv().toUtf8();
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
    QMessageBox::warning(this, tr("Save individuals"), tr("%1 cannot be written: %2").arg(path, file.errorString()));
}

void IndividualsTable::showMenu(const QPoint& place) {
  const QModelIndex index = view_->indexAt(place);
  if (!index.isValid()) return;
  const IndividualRecord record = filter_.recordAt(index);
  QMenu menu(this);
  menu.addAction(themeIcon("media-playback-start"), tr("Replay individual %1").arg(record.id), this,
                 [this, id = record.id] { emit replayRequested(id); });
  if (const std::vector<Id> pair = selectedAll(); pair.size() == 2)
    menu.addAction(themeIcon("view-split-left-right"), tr("Replay %1 and %2 side by side").arg(pair[0]).arg(pair[1]),
                   this, [this, pair] { emit pairRequested(pair[0], pair[1]); });
  if (record.sameAs)
    menu.addAction(themeIcon("go-jump"), tr("Go to individual %1, which it repeats").arg(record.sameAs), this,
                   [this, id = record.sameAs] { select(id); });
  menu.addSeparator();
  menu.addAction(themeIcon("edit-copy"), tr("Copy rows as CSV"), this, &IndividualsTable::copyCsv);
  menu.addAction(tr("Copy chromosome"), this,
                 [text = QString::fromStdString(record.chromosome)] { QApplication::clipboard()->setText(text); });
  menu.exec(view_->viewport()->mapToGlobal(place));
}

bool IndividualsTable::eventFilter(QObject* watched, QEvent* event) {
  if (watched == view_ && event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->matches(QKeySequence::Copy)) {
      copyCsv();
      return true;
    }
    if ((key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter) && selectedAll().size() == 2) {
      const std::vector<Id> pair = selectedAll();
      emit pairRequested(pair[0], pair[1]);
      return true;
    }
    if ((key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter) && selected() != 0) {
      emit replayRequested(selected());
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace btr::ui
