#pragma once
#include <QMainWindow>
#include <string>

class QDockWidget;

namespace btr::ui {
class ConsolePanel;
class ProgramRecord;
class EyePanel;
class ExtraView;
class LiveView;
class LiveWorld;

/// The main 3D view with as many further views and robots' cameras around it as
/// are wanted: docks that can also stand as windows of their own. Borrows the
/// world.
class LiveDesk : public QMainWindow {
  Q_OBJECT
 public:
  /// `view` becomes the middle.
  LiveDesk(LiveWorld& world, LiveView* view, QWidget* parent = nullptr);

  ExtraView* addView();
  EyePanel* addEye();
  /// What robots' own programs say, and their lamps; there is one.
  ConsolePanel* showConsole();
  QList<ExtraView*> views() const;
  QList<EyePanel*> eyes() const;

  /// Cameras and docks, as JSON for the game's file.
  std::string state() const;
  /// Puts back what state() gave; what it cannot read is left out. "" leaves
  /// everything as it is.
  void restore(const std::string& state);

 signals:
  /// For the page's banner.
  void problem(const QString& why);

 private:
  class QDockWidget* addDock(QWidget* content, const QString& title, Qt::DockWidgetArea area);
  void closeAll();
  void askContacts();

  LiveWorld& world_;
  LiveView* view_;
  ProgramRecord* programs_;
  int counted_ = 0;
};

}  // namespace btr::ui
