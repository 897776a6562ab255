#pragma once
class QWidget;

namespace btr::ui {

/// A form's undo steps are whole edits; a line edit's own undo of single keys would shadow them. After this call the
/// keys for undo and redo go on to the form's actions.
void leaveUndoToForm(QWidget* edit);

}  // namespace btr::ui
