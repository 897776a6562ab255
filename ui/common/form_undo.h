#pragma once
class QLineEdit;

namespace btr::ui {

/// A form's undo steps are whole edits; the line edit's own undo of single keys would shadow them. After this call the
/// keys for undo and redo go on to the form's actions.
void leaveUndoToForm(QLineEdit* edit);

}  // namespace btr::ui
