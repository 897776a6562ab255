#include "ui/window/shortcuts_dialog.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QSet>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/common/look/fit_screen.h"

namespace btr::ui {
namespace {

QList<QAction*> entriesOf(const QMenu& menu) {
  QList<QAction*> entries;
  for (QAction* action : menu.actions()) {
    if (action->menu())
      entries += entriesOf(*action->menu());
    else
      entries << action;
  }
  return entries;
}

QString pageOf(const QAction& action) {
  for (const QObject* above = action.parent(); above; above = above->parent())
    if (const auto* dock = qobject_cast<const QDockWidget*>(above)) return dock->windowTitle();
  return {};
}

}  // namespace

ShortcutsDialog::ShortcutsDialog(QWidget& window) : QDialog(&window), table_(new QTableWidget(0, 3, this)) {
  setObjectName("shortcuts");
  setWindowTitle(tr("Keyboard shortcuts"));
  table_->setHorizontalHeaderLabels({tr("Where"), tr("What"), tr("Keys")});
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setTabKeyNavigation(false);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  QSet<const QAction*> shown;
  if (const auto* main = qobject_cast<QMainWindow*>(&window))
    for (const QAction* top : main->menuBar()->actions()) {
      if (!top->menu()) continue;
      for (const QAction* action : entriesOf(*top->menu())) {
        shown << action;
        add(top->text(), *action);
      }
    }
  for (const QAction* action : window.findChildren<QAction*>())
    if (const QString page = pageOf(*action); !shown.contains(action) && !page.isEmpty()) add(page, *action);
  table_->resizeColumnsToContents();

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(table_, 1);
  column->addWidget(buttons);
  resizeWithinScreen(*this, {620, 560});
}

void ShortcutsDialog::add(const QString& place, const QAction& action) {
  if (action.shortcut().isEmpty() || action.text().isEmpty()) return;
  QString text = action.text(), where = place;
  const int row = table_->rowCount();
  table_->insertRow(row);
  table_->setItem(row, 0, new QTableWidgetItem(where.remove('&')));
  table_->setItem(row, 1, new QTableWidgetItem(text.remove('&')));
  QStringList keys;
  for (const QKeySequence& key : action.shortcuts()) keys << key.toString(QKeySequence::NativeText);
  keys.removeDuplicates();
  table_->setItem(row, 2, new QTableWidgetItem(keys.join(", ")));
}

}  // namespace btr::ui
