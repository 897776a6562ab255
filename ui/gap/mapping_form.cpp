#include "ui/gap/mapping_form.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QTableWidget>
#include <QUndoCommand>
#include <QVBoxLayout>
#include <cmath>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/residual.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/numbers/number_entry.h"

namespace btr::ui {
namespace {

/// The whole draft before and after one change.
class ChangeMapping final : public QUndoCommand {
 public:
  ChangeMapping(const QString& text, MappingDraft before, MappingDraft after,
                std::function<void(const MappingDraft&)> apply)
      : QUndoCommand(text), before_(std::move(before)), after_(std::move(after)), apply_(std::move(apply)) {}
  void undo() override { apply_(before_); }
  void redo() override { apply_(after_); }

 private:
  MappingDraft before_, after_;
  std::function<void(const MappingDraft&)> apply_;
};

/// A cell that offers words; other text may be typed where `free`.
class WordsDelegate final : public QStyledItemDelegate {
 public:
  using Words = std::function<QStringList(int row)>;
  WordsDelegate(Words words, bool free, QObject* parent)
      : QStyledItemDelegate(parent), words_(std::move(words)), free_(free) {}
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem&, const QModelIndex& index) const override {
    auto* box = new QComboBox(parent);
    box->setEditable(free_);
    box->addItems(words_(index.row()));
    return box;
  }
  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    auto* box = static_cast<QComboBox*>(editor);
    box->setCurrentIndex(box->findText(index.data().toString()));
    if (free_) box->setEditText(index.data().toString());
  }
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
    model->setData(index, static_cast<QComboBox*>(editor)->currentText());
  }

 private:
  Words words_;
  bool free_;
};

QString unitOf(const MappingRow& row) {
  const auto scale = readNumber(row.scale).value;
  if (scale)
    for (const auto& [name, factor] : unitsFor(row.channel))
      if (std::abs(*scale - factor) <= 1e-9 * factor) return name;
  return QStringLiteral("×");
}

QString rangeOf(const MappingRow& row, const CsvPreview& preview) {
  const qsizetype column = preview.columns.indexOf(row.column);
  const auto scale = readNumber(row.scale).value, offset = readNumber(row.offset).value;
  if (column < 0 || !scale || !offset) return {};
  auto [low, high] = preview.ranges[std::size_t(column)];
  if (std::isnan(low)) return MappingForm::tr("no numbers");
  const double factor = row.flipped ? -*scale : *scale;
  low = low * factor + *offset;
  high = high * factor + *offset;
  if (low > high) std::swap(low, high);
  const QString unit = QString::fromStdString(unitOfChannel(row.channel.toStdString()));
  return MappingForm::tr("%1 … %2").arg(shortNumber(low), withUnit(high, unit));
}

}  // namespace

MappingForm::MappingForm(QWidget* parent)
    : QWidget(parent),
      table_(new QTableWidget(0, columns, this)),
      title_(new QLabel(this)),
      problem_(new QLabel(this)) {
  title_->setWordWrap(true);
  problem_->setWordWrap(true);
  problem_->setObjectName("problem");
  table_->setObjectName("mapping");
  table_->setAccessibleName(tr("Mapping of columns to channels"));
  table_->setHorizontalHeaderLabels(
      {tr("Channel"), tr("Column of the file"), tr("Unit there"), tr("Scale"), tr("Flip"), tr("Offset"), tr("Gives")});
  const char* hints[] = {
      "ROBOT.JOINT.QUANTITY, ROBOT.base.QUANTITY, BALL.QUANTITY or time_s; the unit stands at the end",
      "Name in the first line of the CSV file",
      "Chooses the scale",
      "value = ± scale · x + offset",
      "Turns the sign",
      "In the channel's unit, added after scaling",
      "Smallest and largest of the first 5000 rows"};
  for (int i = 0; i < columns; ++i) table_->horizontalHeaderItem(i)->setToolTip(tr(hints[i]));
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 10);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  // No stretched last column: it would be what the others leave, and in a narrow window half of a range is none.
  table_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  table_->setSelectionBehavior(QAbstractItemView::SelectItems);
  table_->setAlternatingRowColors(true);
  table_->setTabKeyNavigation(true);
  table_->setItemDelegateForColumn(channel, new WordsDelegate([this](int) { return channels_; }, true, table_));
  table_->setItemDelegateForColumn(column, new WordsDelegate([this](int) { return preview_.columns; }, true, table_));
  const auto units = [this](int row) {
    QStringList names;
    for (const auto& [name, factor] : unitsFor(draft_.rows[std::size_t(row)].channel)) names << name;
    return names;
  };
  table_->setItemDelegateForColumn(unit, new WordsDelegate(units, false, table_));
  connect(table_, &QTableWidget::cellChanged, this, &MappingForm::readCell);

  add_ = new QPushButton(themeIcon("list-add"), tr("Add channel"), this);
  remove_ = new QPushButton(themeIcon("list-remove"), tr("Remove channel"), this);
  save_ = new QPushButton(themeIcon("document-save"), tr("Save mapping"), this);
  save_->setObjectName("saveMapping");
  forAll_ = new QCheckBox(tr("For all recordings of the folder"), this);
  forAll_->setObjectName("mappingForAll");
  forAll_->setToolTip(
      tr("Saves it as mapping.json: for every recording of the folder that has no mapping of its own name"));
  connect(forAll_, &QCheckBox::clicked, this, &MappingForm::setForAll);
  connect(add_, &QPushButton::clicked, this, &MappingForm::addRow);
  connect(remove_, &QPushButton::clicked, this, &MappingForm::removeRow);
  connect(save_, &QPushButton::clicked, this, [this] {
    try {
      save();
    } catch (const std::exception& error) {
      emit failed(QString::fromUtf8(error.what()));
    }
  });
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(add_);
  buttons->addWidget(remove_);
  buttons->addStretch(1);
  buttons->addWidget(forAll_);
  buttons->addWidget(save_);
  for (const auto& [action, keys] : {std::pair{undo_.createUndoAction(this), QKeySequence::Undo},
                                     std::pair{undo_.createRedoAction(this), QKeySequence::Redo}}) {
    action->setShortcut(keys);
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    addAction(action);
  }
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title_);
  layout->addWidget(table_, 1);
  layout->addWidget(problem_);
  layout->addLayout(buttons);
  connect(&undo_, &QUndoStack::cleanChanged, this, [this] { show(); });
  show();
}

void MappingForm::open(const QString& recording, const QString& mapping) {
  CsvPreview preview = previewCsv(recording);
  QString found = mapping;
  if (found.isEmpty()) found = QString::fromStdString(findMapping(recording.toStdString()).value_or(""));
  const bool known = !found.isEmpty() && QFileInfo::exists(found);
  MappingDraft draft = known ? MappingDraft::fromJson(readFile(found.toStdString()), found.toStdString())
                             : MappingDraft::guess(preview.columns);
  recording_ = recording;
  // A mapping of other recordings, such as the scene's, stays as it is: what is made of it for this one is this one's.
  const bool fits = !found.isEmpty() && (!known || problemsOf(draft, preview.columns).empty());
  file_ = fits ? found : fileOfOne();
  readFrom_ = known && file_ == found ? found : QString();
  preview_ = std::move(preview);
  draft_ = std::move(draft);
  undo_.clear();
  // clear() leaves an empty stack as clean or unclean as it was.
  if (known)
    undo_.setClean();
  else
    undo_.resetClean();
  show();
}

QString MappingForm::fileOfOne() const {
  const QFileInfo info(recording_);
  return info.path() + '/' + info.completeBaseName() + ".mapping.json";
}

QString MappingForm::fileOfAll() const { return QFileInfo(recording_).path() + "/mapping.json"; }

void MappingForm::setForAll(bool all) {
  file_ = all ? fileOfAll() : fileOfOne();
  show();
}

void MappingForm::setChannels(const QStringList& channels) { channels_ = channels; }

void MappingForm::save() {
  if (const MappingProblems wrong = problems(); !wrong.empty())
    throw InputError(file_.toStdString() + ": not saved: " + wrong.begin()->second.toStdString());
  if (file_ != readFrom_ && QFileInfo::exists(file_))
    throw InputError(file_.toStdString() + ": not saved: it is there already, for other recordings; look at it first");
  writeFile(file_.toStdString(), draft_.toJson());
  readFrom_ = file_;
  undo_.setClean();
  show();
  emit saved(file_);
}

void MappingForm::change(const QString& text, MappingDraft next) {
  if (next == draft_) return show();
  undo_.push(new ChangeMapping(text, draft_, std::move(next), [this](const MappingDraft& draft) {
    draft_ = draft;
    show();
  }));
}

void MappingForm::addRow() {
  MappingDraft next = draft_;
  next.rows.push_back({});
  change(tr("Add channel"), std::move(next));
  table_->setCurrentCell(table_->rowCount() - 1, channel);
}

void MappingForm::removeRow() {
  const int row = table_->currentRow();
  if (row < 0 || row >= int(draft_.rows.size())) return;
  MappingDraft next = draft_;
  next.rows.erase(next.rows.begin() + row);
  change(tr("Remove channel"), std::move(next));
}

void MappingForm::readCell(int row, int at) {
  if (showing_ || row >= int(draft_.rows.size())) return;
  MappingDraft next = draft_;
  MappingRow& changed = next.rows[std::size_t(row)];
  const QTableWidgetItem* item = table_->item(row, at);
  const QString text = item->text().trimmed();
  if (at == channel) changed.channel = text;
  if (at == column) changed.column = text;
  // A scale that nobody chose is the one of the unit in the heading.
  if ((at == channel || at == column) && changed.scale == MappingRow{}.scale)
    if (const auto factor = unitInHeading(changed.column, changed.channel))
      changed.scale = QString::fromStdString(toText(*factor));
  if (at == scale) changed.scale = text;
  if (at == offset) changed.offset = text;
  if (at == flip) changed.flipped = item->checkState() == Qt::Checked;
  if (at == unit)
    for (const auto& [name, factor] : unitsFor(changed.channel))
      if (name == text) changed.scale = QString::fromStdString(toText(factor));
  change(tr("Edit mapping"), std::move(next));
}

void MappingForm::show() {
  showing_ = true;
  const QPoint place(table_->currentRow(), table_->currentColumn());
  const MappingProblems wrong = problems();
  const Tones tones = tonesOf(palette());
  table_->setRowCount(int(draft_.rows.size()));
  for (int i = 0; i < table_->rowCount(); ++i) {
    const MappingRow& row = draft_.rows[std::size_t(i)];
    const auto put = [&](int at, const QString& text, std::optional<MappingField> field, bool editable = true) {
      // Items stay: one of them may be the one that was just edited.
      QTableWidgetItem* item = table_->item(i, at);
      if (!item) table_->setItem(i, at, item = new QTableWidgetItem);
      item->setText(text);
      item->setFlags(Qt::ItemIsSelectable | Qt::ItemIsEnabled | (editable ? Qt::ItemIsEditable : Qt::NoItemFlags));
      const auto problem = field ? wrong.find({i, *field}) : wrong.end();
      QColor ground = tones.bad;
      ground.setAlpha(60);
      item->setBackground(problem != wrong.end() ? QBrush(ground) : QBrush());
      item->setToolTip(problem != wrong.end() ? problem->second : QString());
      return item;
    };
    put(channel, row.channel, MappingField::channel);
    put(column, row.column, MappingField::column);
    put(unit, unitOf(row), {});
    put(scale, row.scale, MappingField::scale)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    put(offset, row.offset, MappingField::offset)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    put(range, rangeOf(row, preview_), {}, false)->setForeground(tones.muted);
    QTableWidgetItem* check = put(flip, {}, {}, false);
    check->setFlags(check->flags() | Qt::ItemIsUserCheckable);
    check->setCheckState(row.flipped ? Qt::Checked : Qt::Unchecked);
  }
  if (place.x() >= 0 && place.x() < table_->rowCount()) table_->setCurrentCell(place.x(), place.y());
  showing_ = false;
  title_->setText(recording_.isEmpty() ? tr("Choose a recording first")
                                       : tr("%1 → %2%3")
                                             .arg(QFileInfo(recording_).fileName(), QFileInfo(file_).fileName(),
                                                  isChanged() ? tr(" (not saved)") : QString()));
  QStringList texts;
  for (const auto& [where, text] : wrong)
    texts << (where.first < 0 ? text : tr("Line %1: %2").arg(where.first + 1).arg(text));
  QPalette colours = problem_->palette();
  colours.setColor(QPalette::WindowText, tones.bad);
  problem_->setPalette(colours);
  problem_->setText(recording_.isEmpty() ? QString() : texts.mid(0, 3).join('\n'));
  save_->setEnabled(wrong.empty() && !recording_.isEmpty());
  // Where the mapping is another file's (the scene's, one that was chosen), that is not asked.
  forAll_->setVisible(!recording_.isEmpty() && (file_ == fileOfOne() || file_ == fileOfAll()));
  forAll_->setChecked(!recording_.isEmpty() && file_ == fileOfAll());
  add_->setEnabled(!recording_.isEmpty());
  remove_->setEnabled(!recording_.isEmpty());
}

}  // namespace btr::ui
