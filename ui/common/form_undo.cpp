#include "ui/common/form_undo.h"

#include <QKeyEvent>
#include <QWidget>

namespace btr::ui {
namespace {

class UndoKeysPass final : public QObject {
 public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::ShortcutOverride) {
      auto* key = static_cast<QKeyEvent*>(event);
      if (key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo)) {
        event->ignore();
        return true;
      }
    }
    return QObject::eventFilter(watched, event);
  }
};

}  // namespace

void leaveUndoToForm(QWidget* edit) { edit->installEventFilter(new UndoKeysPass(edit)); }

}  // namespace btr::ui
