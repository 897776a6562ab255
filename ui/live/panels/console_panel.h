#pragma once
#include <QWidget>

class QComboBox;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QTableWidget;

namespace btr::ui {
class LiveWorld;
class ProgramRecord;
struct ProgramLine;

/// What robots' own programs say, by robot and object; a line to type for those that read their console; which of them
/// run, and why others ended; the lamps that they lit. Borrows world and record.
class ConsolePanel : public QWidget {
  Q_OBJECT
 public:
  ConsolePanel(LiveWorld& world, ProgramRecord& record, QWidget* parent = nullptr);

  QPlainTextEdit* text() const { return text_; }
  QTableWidget* lamps() const { return lamps_; }

 private:
  QWidget* makeConsole();
  void showLine(const ProgramLine& line);
  void showAll();
  void showStates();
  void showLamps();
  void typed();
  QString robot() const;  ///< whose lines are shown; "": all

  LiveWorld& world_;
  ProgramRecord& record_;
  QComboBox* robot_;
  QLabel* states_;
  QPlainTextEdit* text_;
  QLineEdit* input_;
  QTableWidget* lamps_;
};

}  // namespace btr::ui
