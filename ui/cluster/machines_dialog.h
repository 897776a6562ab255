#pragma once
#include <QDialog>
#include <functional>

#include "ui/controllers/machines_controller.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace btr::ui {

/// Run, On several machines: what is worked on where, how it goes, and what can be done about it.
class MachinesDialog : public QDialog {
  Q_OBJECT
 public:
  /// `database`: the one that is open; empty: none.
  MachinesDialog(MachinesController& controller, std::function<QString()> database, QWidget* parent = nullptr);

  MachinesOrder order() const;
  void setFile(const QString& file);

 private:
  QLayout* makeForm();
  QLayout* makeButtons();
  void chooseFile();
  void chooseFolder();
  void chooseJob();
  void start();
  void showWay();
  void suggestFolder();
  void showJob(const JobStatus& status);
  QString speedTitle(const JobStatus& status) const;
  void showArray(const JobStatus& status);
  void showRanks(const JobStatus& status);
  void refresh();
  void tell(const QString& sentence, bool isProblem);
  MachinesOrder::Way way() const;

  MachinesController& controller_;
  std::function<QString()> database_;
  QLineEdit *file_, *folder_, *options_;
  QLabel *into_, *hostsLabel_, *optionsLabel_, *ranksLabel_, *job_, *message_;
  QComboBox* way_;
  QPlainTextEdit* hosts_;
  QSpinBox *ranks_, *workers_;
  QTableWidget* parts_;
  QProgressBar* progress_;
  QPushButton *start_, *open_, *cancel_, *resume_, *collect_;
  bool isFolderOurs_ = true;  ///< the user named none: it follows the file
};

}  // namespace btr::ui
