// The Edit menu: acts on whatever has the focus, a form, the measurement sheet, a table or a field.
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QUndoStack>

#include "ui/common/look/theme.h"
#include "ui/experiment/experiment_form.h"
#include "ui/live/live_page.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/window/window_menus.h"

namespace btr::ui {
namespace {

/// The undo stack of the page that a widget stands on, or null.
QUndoStack* stackOf(QWidget* widget) {
  for (; widget; widget = widget->parentWidget()) {
    if (auto* form = qobject_cast<ExperimentForm*>(widget)) return &form->undoStack();
    if (auto* sheet = qobject_cast<MeasurementSheet*>(widget)) return &sheet->model().undoStack();
  }
  return nullptr;
}

/// The running world that a widget belongs to, or null.
const LivePage* sceneOf(const QWidget* widget) {
  for (; widget; widget = widget->parentWidget())
    if (const auto* page = qobject_cast<const LivePage*>(widget)) return page;
  return nullptr;
}

/// As if the user had pressed the key there: each page knows what it means to it.
void press(QWidget* widget, QKeySequence::StandardKey key) {
  const QKeySequence keys(key);
  if (!widget || keys.isEmpty()) return;
  const QKeyCombination first = keys[0];
  QKeyEvent event(QEvent::KeyPress, first.key(), first.keyboardModifiers());
  QApplication::sendEvent(widget, &event);
}

}  // namespace

void makeEditMenu(QMainWindow& window) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("EditMenu", text); };
  QMenu* menu = window.menuBar()->addMenu(tr("&Edit"));
  // The pages answer the keys themselves, wherever the focus is; here they are only shown. As shortcuts of the whole
  // window they would compete with them.
  const auto add = [menu, &window](const QString& name, const QString& icon, const QString& text,
                                   QKeySequence::StandardKey key, auto slot) {
    QAction* action = menu->addAction(themeIcon(icon), text);
    action->setObjectName("edit." + name);
    action->setShortcutContext(Qt::WidgetShortcut);
    action->setShortcut(key);
    QObject::connect(action, &QAction::triggered, &window, slot);
    return action;
  };
  QAction* undo = add("undo", "edit-undo", tr("&Undo"), QKeySequence::Undo, [] {
    if (QUndoStack* stack = stackOf(QApplication::focusWidget())) return stack->undo();
    press(QApplication::focusWidget(), QKeySequence::Undo);
  });
  QAction* redo = add("redo", "edit-redo", tr("&Redo"), QKeySequence::Redo, [] {
    if (QUndoStack* stack = stackOf(QApplication::focusWidget())) return stack->redo();
    press(QApplication::focusWidget(), QKeySequence::Redo);
  });
  menu->addSeparator();
  QList<QAction*> others;
  for (const auto& [name, icon, text, key] :
       {std::tuple{"cut", "edit-cut", tr("Cu&t"), QKeySequence::Cut},
        std::tuple{"copy", "edit-copy", tr("&Copy"), QKeySequence::Copy},
        std::tuple{"paste", "edit-paste", tr("&Paste"), QKeySequence::Paste},
        std::tuple{"selectAll", "edit-select-all", tr("Select &all"), QKeySequence::SelectAll}})
    others << add(name, icon, text, key, [key = key] { press(QApplication::focusWidget(), key); });

  QObject::connect(menu, &QMenu::aboutToShow, &window, [undo, redo, others] {
    QWidget* focus = QApplication::focusWidget();
    const QUndoStack* stack = stackOf(focus);
    const auto* line = qobject_cast<QLineEdit*>(focus);
    const LivePage* scene = sceneOf(focus);
    undo->setEnabled(stack ? stack->canUndo() : scene ? scene->canUndo() : line && line->isUndoAvailable());
    redo->setEnabled(stack ? stack->canRedo() : scene ? scene->canRedo() : line && line->isRedoAvailable());
    for (QAction* action : others) action->setEnabled(focus);
  });
  // Closed, they can always be triggered: what does not fit does nothing.
  QObject::connect(menu, &QMenu::aboutToHide, &window, [undo, redo, others] {
    for (QAction* action : others + QList<QAction*>{undo, redo}) action->setEnabled(true);
  });
}

}  // namespace btr::ui
