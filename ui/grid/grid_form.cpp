#include "ui/grid/grid_form.h"

#include <QCheckBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <algorithm>
#include <filesystem>

#include "core/run/grid/grid_cells.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "ui/common/look/fit_screen.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/resources.h"
#include "ui/common/wheel_guard.h"
#include "ui/experiment/parameter_form.h"

namespace btr::ui {
namespace {

QString listText(const std::vector<double>& values, double scale) {
  QStringList texts;
  for (const double value : values) texts << QString::number(value * scale, 'g', 5).replace('-', QChar(u'−'));
  return texts.join(QStringLiteral(", "));
}

QStringList parts(QString text) {
  static const QRegularExpression between(QStringLiteral("[,;\\s]+"));
  return text.replace(QChar(u'−'), '-').split(between, Qt::SkipEmptyParts);
}

QString axisName(std::size_t axis) {
  return std::array{GridForm::tr("Distances of the ball"), GridForm::tr("Bearings of the ball"),
                    GridForm::tr("Directions of the kick")}[axis];
}

/// `read` makes one number of a part, `numbers` are its kind in words.
template <class Read>
auto listIn(const QString& text, const std::string& what, const std::string& numbers, Read read) {
  std::vector<decltype(read(QString(), nullptr))> values;
  for (const QString& part : parts(text)) {
    bool isNumber = false;
    values.push_back(read(part, &isNumber));
    if (!isNumber) throw InputError(what, "\"" + part.toStdString() + "\"", numbers + " with commas between them");
  }
  return values;
}

/// One comma inside of what might be a number, and nothing that says what it means.
QString doubtfulPart(const QString& text) {
  static const QRegularExpression space(QStringLiteral("\\s+")), one(QStringLiteral("^[^,.]*\\d,\\d[^,.]*$"));
  const QStringList words = text.split(space, Qt::SkipEmptyParts);
  const bool commasBetween = std::ranges::any_of(words, [](const QString& word) { return word.endsWith(','); });
  if (words.size() > 1 && !commasBetween) return {};
  for (const QString& word : words)
    if (one.match(word.endsWith(',') ? word.chopped(1) : word).hasMatch()) return word;
  return {};
}

/// "0.1, 0.2", "0.1,0.2" and "0.1 0.2", or "0,1; 0,2" and "0,1 0,2". "5,7" alone could be one number or two.
std::vector<double> numbersIn(QString text, const std::string& what) {
  static const QRegularExpression decimal(QStringLiteral("(\\d),(\\d)"));
  const bool semicolons = text.contains(';');
  const QString doubtful = semicolons ? QString() : doubtfulPart(text);
  if (!doubtful.isEmpty())
    throw InputError(what, "\"" + doubtful.toStdString() + "\", which could be one number or two",
                     "a point in a number, or a semicolon or a space between two");
  const QStringList words = text.simplified().split(' ');
  const bool spaced = words.size() > 1 && std::ranges::none_of(words, [](const QString& word) {
                        return word.endsWith(',') || word.count(',') > 1 || (word.contains(',') && word.contains('.'));
                      });
  if (semicolons || spaced) text.replace(decimal, QStringLiteral("\\1.\\2"));
  return listIn(text, what, "numbers", [](const QString& part, bool* good) { return part.toDouble(good); });
}

std::vector<std::uint64_t> seedsIn(const QString& text, const std::string& what) {
  return listIn(text, what, "whole numbers",
                [](const QString& part, bool* good) -> std::uint64_t { return part.toULongLong(good); });
}

}  // namespace

GridForm::GridForm(QWidget* parent) : QDialog(parent) {
  WheelGuard::ensure();
  setWindowTitle(tr("New grid of experiments"));
  setObjectName("gridForm");
  name_ = new QLineEdit;
  experiment_ = new QLineEdit;
  seeds_ = new QLineEdit;
  name_->setObjectName("name");
  experiment_->setObjectName("experiment");
  seeds_->setObjectName("seeds");
  seeds_->setToolTip(tr("Whole numbers with commas between them; every method learns the grid once for each"));
  auto* browse = new QPushButton(themeIcon("document-open"), tr("Choose…"));
  auto* experiment = new QWidget;
  auto* experimentRow = new QHBoxLayout(experiment);
  experimentRow->setContentsMargins(0, 0, 0, 0);
  experimentRow->addWidget(experiment_, 1);
  experimentRow->addWidget(browse);
  connect(browse, &QPushButton::clicked, this, &GridForm::chooseExperiment);

  auto* form = new QFormLayout;
  form->addRow(tr("&Name"), name_);
  form->addRow(tr("&Experiment"), experiment);
  const std::array labels{tr("&Distances of the ball [m]"), tr("&Bearings of the ball [°]"),
                          tr("Di&rections of the kick [°]")};
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    axes_[axis].edit = new QLineEdit;
    axes_[axis].edit->setObjectName(GridSpec::axisKeys[axis]);
    axes_[axis].edit->setToolTip(
        axis == 0 ? tr("From the neck to the ball, ascending, with commas between them; with decimal commas "
                       "semicolons")
                  : tr("0 ahead, positive left; ascending, with commas between them"));
    form->addRow(labels[axis], axes_[axis].edit);
  }
  mirrored_ = new QCheckBox(tr("Kicks to the right are mirror images of those to the left"));
  form->addRow(QString(), mirrored_);
  auto* methods = new QWidget;
  auto* methodsRow = new QHBoxLayout(methods);
  methodsRow->setContentsMargins(0, 0, 0, 0);
  const std::array tips{tr("Every cell learns for itself"),
                        tr("From straight ahead outwards: a cell's population begins at a neighbour's good solution"),
                        tr("All cells at once; likeness to the neighbours is a factor of fitness")};
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    const char* method = toText(static_cast<GridSpec::Method>(k));
    methods_[k] = new QCheckBox(QString::fromLatin1(method));
    methods_[k]->setObjectName(method);
    methods_[k]->setToolTip(tips[k]);
    methodsRow->addWidget(methods_[k]);
  }
  methodsRow->addStretch(1);
  form->addRow(tr("Methods"), methods);
  form->addRow(tr("&Seeds"), seeds_);
  settings_ = new ParameterForm(gridParameters(), undo_, this);
  summary_ = new QLabel;
  problem_ = new QLabel;
  problem_->setObjectName("problem");
  for (QLabel* label : {summary_, problem_}) label->setWordWrap(true);
  problem_->setStyleSheet(QStringLiteral("color: %1").arg(tonesOf(palette()).bad.name()));

  auto* inner = new QWidget;
  auto* column = new QVBoxLayout(inner);
  column->addLayout(form);
  column->addWidget(settings_);
  column->addStretch(1);
  auto* scroll = new QScrollArea;
  scroll->setWidget(inner);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(makeFileBar());
  layout->addWidget(scroll, 1);
  layout->addWidget(summary_);
  layout->addWidget(problem_);
  layout->addLayout(makeButtons());
  resizeWithinScreen(*this, {640, 660});

  for (QLineEdit* edit : {name_, experiment_, seeds_, axes_[0].edit, axes_[1].edit, axes_[2].edit})
    connect(edit, &QLineEdit::textChanged, this, &GridForm::refresh);
  for (QCheckBox* box : {mirrored_, methods_[0], methods_[1], methods_[2]})
    connect(box, &QCheckBox::toggled, this, &GridForm::refresh);
  connect(settings_, &ParameterForm::changed, this, &GridForm::refresh);
  connect(settings_, &ParameterForm::validChanged, this, &GridForm::refresh);
  refresh();
}

QWidget* GridForm::makeFileBar() {
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  auto* open = new QPushButton(themeIcon("document-open"), tr("&Open"), bar);
  auto* menu = new QMenu(open);
  for (const QString& path : exampleGrids())
    menu->addAction(QFileInfo(path).completeBaseName(), this, [this, path] { tryTo([&] { openFile(path); }); });
  menu->addSeparator();
  menu->addAction(tr("Another file…"), this, &GridForm::chooseFile);
  open->setMenu(menu);
  fileLabel_ = new QLabel(bar);
  fileLabel_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  row->addWidget(open);
  row->addWidget(fileLabel_, 1);
  return bar;
}

QLayout* GridForm::makeButtons() {
  auto* row = new QHBoxLayout;
  save_ = new QPushButton(themeIcon("document-save-as"), tr("Save &as…"), this);
  start_ = new QPushButton(themeIcon("media-playback-start"), tr("S&tart"), this);
  start_->setObjectName("start");
  start_->setDefault(true);
  auto* cancel = new QPushButton(tr("Cancel"), this);
  for (QPushButton* button : {save_, cancel}) button->setAutoDefault(false);
  row->addWidget(save_);
  row->addStretch(1);
  row->addWidget(cancel);
  row->addWidget(start_);
  connect(save_, &QPushButton::clicked, this, &GridForm::chooseTarget);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(start_, &QPushButton::clicked, this, [this] {
    emit startRequested();
    accept();
  });
  return row;
}

void GridForm::openFile(const QString& path) {
  loaded_ = loadGrid(path.toStdString());
  file_ = path;
  name_->setText(QString::fromStdString(loaded_.name));
  experiment_->setText(QString::fromStdString(loaded_.experiment));
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    axes_[axis].values = loaded_.axes[axis];
    axes_[axis].shown = listText(loaded_.axes[axis], axis == 0 ? 1 : inDegrees);
    axes_[axis].edit->setText(axes_[axis].shown);
  }
  mirrored_->setChecked(loaded_.mirroredDerived);
  for (std::size_t k = 0; k < methods_.size(); ++k)
    methods_[k]->setChecked(std::ranges::count(loaded_.methods, static_cast<GridSpec::Method>(k)) > 0);
  QStringList seeds;
  for (const std::uint64_t seed : loaded_.seeds) seeds << QString::number(seed);
  seeds_->setText(seeds.join(QStringLiteral(", ")));
  settings_->setValues(loaded_.settings);
  refresh();
}

/// What is chosen in a file is relative to the file.
std::string GridForm::experimentPath() const {
  const std::filesystem::path folder = std::filesystem::path(file_.toStdString()).parent_path();
  return std::filesystem::absolute(folder / experiment_->text().trimmed().toStdString()).lexically_normal().string();
}

GridSpec GridForm::spec() const {
  GridSpec grid;
  grid.file = file_.toStdString();
  grid.name = name_->text().trimmed().toStdString();
  grid.experiment = experiment_->text().trimmed().toStdString();
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const Axis& a = axes_[axis];
    grid.axes[axis] = a.values;
    if (a.edit->text() == a.shown) continue;
    grid.axes[axis] = numbersIn(a.edit->text(), axisName(axis).toStdString());
    for (double& value : grid.axes[axis]) value /= axis == 0 ? 1 : inDegrees;
  }
  grid.mirroredDerived = mirrored_->isChecked();
  for (std::size_t k = 0; k < methods_.size(); ++k)
    if (methods_[k]->isChecked()) grid.methods.push_back(static_cast<GridSpec::Method>(k));
  grid.seeds = seedsIn(seeds_->text(), tr("Seeds").toStdString());
  grid.settings = settings_->values();
  return grid;
}

bool GridForm::isModified() const {
  try {
    return file_.isEmpty() || gridFileText(spec()) != gridFileText(loaded_);
  } catch (const InputError&) {
    return true;
  }
}

QString GridForm::problem() const {
  if (!settings_->isValid()) return settings_->problems().join('\n');
  try {
    gridFromJson(gridFileText(spec()), "");
    loadExperiment(experimentPath());
    return outOfBounds();
  } catch (const std::exception& error) {
    return QString::fromUtf8(error.what()).trimmed();
  }
}

void GridForm::setBounds(Bounds bounds) {
  bounds_ = std::move(bounds);
  refresh();
}

/// In the field's own words and unit.
QString GridForm::outOfBounds() const {
  if (!bounds_) return {};
  GridSpec grid = spec();
  grid.experiment = experimentPath();
  const std::vector<Parameter> axes = bounds_(grid);
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const double scale = axis == 0 ? 1 : inDegrees;
    const QString unit = axis == 0 ? tr(" m") : tr("°");
    const auto shown = [&](double value) { return QString::number(scale * value, 'g', 4) + unit; };
    for (const double value : grid.axes[axis])
      if (value < axes[axis].minimum || value > axes[axis].maximum)
        return tr("%1: %2 is not allowed; %3 to %4")
            .arg(axisName(axis), shown(value), shown(axes[axis].minimum), shown(axes[axis].maximum));
  }
  return {};
}

std::string GridForm::portableText() const {
  GridSpec grid = spec();
  grid.experiment = experimentPath();
  return gridFileText(grid);
}

void GridForm::saveFile(const QString& path) {
  GridSpec grid = spec();
  grid.experiment =
      QFileInfo(path).absoluteDir().relativeFilePath(QString::fromStdString(experimentPath())).toStdString();
  writeFile(path.toStdString(), gridFileText(grid));
  openFile(path);
}

void GridForm::chooseFile() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Open grid"), QFileInfo(file_).absolutePath(),
                                                    tr("Grids (*.json);;All files (*)"));
  if (!path.isEmpty()) tryTo([&] { openFile(path); });
}

void GridForm::chooseExperiment() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Experiment of all cells"),
                                                    QFileInfo(QString::fromStdString(experimentPath())).absolutePath(),
                                                    tr("Experiments (*.json);;All files (*)"));
  if (!path.isEmpty()) experiment_->setText(path);
}

void GridForm::chooseTarget() {
  const QString path = QFileDialog::getSaveFileName(
      this, tr("Save grid"), QDir::home().filePath(QStringLiteral("grid.json")), tr("Grids (*.json);;All files (*)"));
  if (!path.isEmpty()) tryTo([&] { saveFile(path); });
}

void GridForm::tryTo(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    problem_->setText(QString::fromUtf8(error.what()));
    problem_->show();
  }
}

void GridForm::refresh() {
  const QString wrong = problem();
  const bool isModified = this->isModified();
  problem_->setText(wrong);
  problem_->setVisible(!wrong.isEmpty());
  start_->setEnabled(wrong.isEmpty());
  save_->setEnabled(wrong.isEmpty());
  fileLabel_->setText(file_.isEmpty() ? tr("no file")
                                      : QFileInfo(file_).fileName() + (isModified ? tr(" (changed)") : QString()));
  fileLabel_->setToolTip(file_);
  summary_->setVisible(wrong.isEmpty());
  if (!wrong.isEmpty()) return;
  const GridSpec grid = spec();
  const std::vector<GridCell> cells = cellsOf(grid);
  const auto learned = std::ranges::count(cells, 0, &GridCell::mirrorOf);
  const auto grids = static_cast<qlonglong>(grid.methods.size() * grid.seeds.size());
  const double generations = valueOf(gridParameters(), grid.settings, "generations");
  summary_->setText(tr("%1 cells, %2 of them learned; %3; %4 generations in all")
                        .arg(cells.size())
                        .arg(learned)
                        .arg(grids == 1 ? tr("one grid") : tr("%1 grids (methods × seeds)").arg(grids))
                        .arg(QLocale::c().toString(qlonglong(generations) * grids * qlonglong(learned))));
}

}  // namespace btr::ui
