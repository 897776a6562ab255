#pragma once
#include <QString>
#include <functional>

class QLineEdit;
class QUndoStack;

namespace btr::ui {

/// What a user types into a line becomes steps of `undo`, called `step`; all that is typed in one visit is one step.
/// `changed` is called after each key, each undo and each redo. What a program sets is no step. The line has a name
/// (objectName()) by which its steps are told from others', and lives as long as the stack.
void makeUndoable(QLineEdit& line, QUndoStack& undo, const QString& step, std::function<void()> changed);

}  // namespace btr::ui
