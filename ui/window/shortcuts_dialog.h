#pragma once
#include <QDialog>

class QAction;
class QTableWidget;

namespace btr::ui {

/// Every key of the window, read from its actions: those of the menus and those of single pages.
class ShortcutsDialog : public QDialog {
  Q_OBJECT
 public:
  explicit ShortcutsDialog(QWidget& window);

 private:
  void add(const QString& place, const QAction& action);
  QTableWidget* table_;
};

}  // namespace btr::ui
