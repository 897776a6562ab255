#include "ui/live/panels/console_panel.h"

#include <QComboBox>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSignalBlocker>
#include <QTabWidget>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "ui/common/form_undo.h"
#include "ui/live/live_world.h"
#include "ui/live/program_record.h"

namespace btr::ui {

ConsolePanel::ConsolePanel(LiveWorld& world, ProgramRecord& record, QWidget* parent)
    : QWidget(parent), world_(world), record_(record) {
  setObjectName("consolePanel");
  auto* tabs = new QTabWidget(this);
  tabs->setDocumentMode(true);
  tabs->addTab(makeConsole(), tr("Console"));
  lamps_ = new QTableWidget(0, 4, tabs);
  lamps_->setObjectName("lampTable");
  lamps_->setHorizontalHeaderLabels({tr("Robot"), tr("Lamp"), tr("Brightness"), tr("Mode")});
  lamps_->horizontalHeader()->setStretchLastSection(true);
  lamps_->verticalHeader()->hide();
  lamps_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  lamps_->setAccessibleName(tr("Lamps"));
  tabs->addTab(lamps_, tr("Lamps"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(tabs);
  connect(&record_, &ProgramRecord::said, this, &ConsolePanel::showLine);
  connect(&record_, &ProgramRecord::cleared, text_, &QPlainTextEdit::clear);
  connect(&record_, &ProgramRecord::statesChanged, this, &ConsolePanel::showStates);
  connect(&world_, &LiveWorld::rowChanged, this, &ConsolePanel::showLamps);
  showStates();
  showAll();
  showLamps();
}

QWidget* ConsolePanel::makeConsole() {
  auto* part = new QWidget(this);
  auto* head = new QHBoxLayout;
  robot_ = new QComboBox(part);
  robot_->setObjectName("consoleRobot");
  robot_->setAccessibleName(tr("Whose lines"));
  states_ = new QLabel(part);
  states_->setObjectName("programStates");
  states_->setWordWrap(true);
  head->addWidget(robot_);
  head->addWidget(states_, 1);
  text_ = new QPlainTextEdit(part);
  text_->setObjectName("consoleText");
  text_->setReadOnly(true);
  text_->setMaximumBlockCount(static_cast<int>(ProgramRecord::mostLines));
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text_->setAccessibleName(tr("What robots' programs say"));
  input_ = new QLineEdit(part);
  input_->setObjectName("consoleInput");
  input_->setPlaceholderText(tr("A line for a program that reads its console"));
  input_->setAccessibleName(tr("Line to type"));
  leaveUndoToForm(input_);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(4, 4, 4, 4);
  column->addLayout(head);
  column->addWidget(text_, 1);
  column->addWidget(input_);
  connect(robot_, &QComboBox::activated, this, &ConsolePanel::showAll);
  connect(input_, &QLineEdit::returnPressed, this, &ConsolePanel::typed);
  return part;
}

QString ConsolePanel::robot() const { return robot_->currentIndex() > 0 ? robot_->currentText() : QString(); }

void ConsolePanel::showLine(const ProgramLine& line) {
  if (!robot().isEmpty() && line.robot != robot()) return;
  const QString who = line.object.isEmpty() ? line.robot : line.robot + ' ' + line.object;
  text_->appendPlainText(who + ": " + line.text);
}

void ConsolePanel::showAll() {
  text_->clear();
  for (const ProgramLine& line : record_.lines()) showLine(line);
}

void ConsolePanel::showStates() {
  const QString chosen = robot();
  {
    const QSignalBlocker quiet(robot_);
    robot_->clear();
    robot_->addItem(tr("All robots"));
    for (const auto& state : record_.states()) robot_->addItem(QString::fromStdString(state.first));
    robot_->setCurrentIndex(std::max(0, robot_->findText(chosen)));
  }
  QStringList texts;
  for (const auto& [name, why] : record_.states())
    texts << (why.isEmpty() ? tr("%1 runs").arg(QString::fromStdString(name))
                            : tr("%1 ended: %2").arg(QString::fromStdString(name), why));
  states_->setText(texts.isEmpty() ? tr("No robot has an OPEN-R program: choose a stick as its controller.")
                                   : texts.join("; "));
  input_->setEnabled(!record_.states().empty());
}

void ConsolePanel::showLamps() {
  if (!isVisible() && lamps_->rowCount() > 0) return;
  int row = 0;
  for (const auto& [robot, orders] : world_.row().orders)
    for (const auto& [name, lamp] : orders.lamps) {
      if (row == lamps_->rowCount()) {
        lamps_->insertRow(row);
        for (int column = 0; column < lamps_->columnCount(); ++column)
          lamps_->setItem(row, column, new QTableWidgetItem);
      }
      const QString percent = tr("%1 %").arg(std::lround(100 * lamp.brightness));
      const QStringList cells{QString::fromStdString(robot), QString::fromStdString(name), percent,
                              QString::fromStdString(lamp.mode)};
      for (int column = 0; column < cells.size(); ++column)
        if (auto* item = lamps_->item(row, column); item->text() != cells[column]) item->setText(cells[column]);
      ++row;
    }
  lamps_->setRowCount(row);
}

void ConsolePanel::typed() {
  QString to = robot();
  if (to.isEmpty() && !record_.states().empty()) to = QString::fromStdString(record_.states().begin()->first);
  world_.process().type(to.toStdString(), input_->text());
  input_->clear();
}

}  // namespace btr::ui
