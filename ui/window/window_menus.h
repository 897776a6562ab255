#pragma once
#include <functional>

class QMainWindow;
class QToolBar;
class QWidget;

namespace btr::ui {
class DockLayout;
class DraftController;
class ReplayController;
class RunController;
class Theme;
class Workbench;
struct WindowPages;

/// What the menus act on.
struct MenuTargets {
  QMainWindow& window;
  Theme& theme;
  Workbench& bench;
  DockLayout& layout;
  WindowPages& pages;
  DraftController& drafts;
  RunController& runs;
  ReplayController& replays;
};

struct MenuPlaces {
  QWidget* alarm;      ///< stands at the end of the tools
  QToolBar* messages;  ///< the tools stand above it
  std::function<void()> resetLayout;
};

/// Menu bar and tools of the window, made once.
void makeWindowMenus(const MenuTargets& targets, const MenuPlaces& places);

/// The Edit menu: acts on whatever has the focus, a form, the measurement sheet, a table or a field.
void makeEditMenu(QMainWindow& window);

}  // namespace btr::ui
