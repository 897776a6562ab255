#pragma once
#include <QObject>

class QLabel;
class QMainWindow;
class QToolBar;

namespace btr::ui {
class MessageBanner;
class Workbench;

/// What the window says by itself: messages above everything, the status line below, and the title.
class WindowMessages : public QObject {
  Q_OBJECT
 public:
  WindowMessages(QMainWindow& window, Workbench& bench);
  MessageBanner& banner() { return *banner_; }
  /// Holds the banner; is there only while it says something.
  QToolBar& bar() { return *bar_; }

 signals:
  void aboutToTakeRoom();  ///< the first message: the docks will be lower

 private:
  void makeBar();
  void makeStatusLine();
  void showDatabase();

  QMainWindow& window_;
  Workbench& bench_;
  MessageBanner* banner_;
  QToolBar* bar_;
  QLabel *database_, *active_, *reading_;
};

}  // namespace btr::ui
