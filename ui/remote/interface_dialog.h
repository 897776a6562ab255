#pragma once
#include <QDialog>
#include <functional>

class QCheckBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace btr::ui {
class InterfaceServer;

/// The switch of the open interface: where it listens, which files it may open, whether it has the open database.
class InterfaceDialog : public QDialog {
  Q_OBJECT
 public:
  /// The server outlives it. `database`: path of the one that is open.
  InterfaceDialog(InterfaceServer& server, std::function<QString()> database, QWidget* parent = nullptr);

 private:
  void turn();
  void tell(const QString& state);

  InterfaceServer& server_;
  std::function<QString()> database_;
  QSpinBox* port_;
  QLineEdit* folder_;
  QCheckBox* runs_;
  QLabel* state_;
  QPushButton* turn_;
};

}  // namespace btr::ui
