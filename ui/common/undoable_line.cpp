#include "ui/common/undoable_line.h"

#include <QLineEdit>
#include <QUndoStack>
#include <memory>
#include <utility>

#include "ui/common/edit_command.h"

namespace btr::ui {

void makeUndoable(QLineEdit& line, QUndoStack& undo, const QString& step, std::function<void()> changed) {
  // A line tells only what it became: the text before an edit is remembered.
  struct Visit {
    int number = 0;
    QString before;
  };
  const auto visit = std::make_shared<Visit>(Visit{.before = line.text()});
  QObject::connect(&line, &QLineEdit::textChanged, &line, [&line, visit](const QString& text) {
    if (!line.isModified()) visit->before = text;
  });
  QObject::connect(&line, &QLineEdit::editingFinished, &line, [visit] { ++visit->number; });
  QObject::connect(&line, &QLineEdit::textEdited, &line,
                   [&line, &undo, visit, step, changed = std::move(changed)](const QString& text) {
                     const QString before = std::exchange(visit->before, text);
                     undo.push(new EditCommand(step, line.objectName(), visit->number, before, text,
                                               [&line, changed](const QVariant& value) {
                                                 if (line.text() != value.toString()) line.setText(value.toString());
                                                 changed();
                                               }));
                   });
}

}  // namespace btr::ui
