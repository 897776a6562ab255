#pragma once

namespace btr::ui {
class DockLayout;
class DraftController;
class GridController;
class MainWindow;
class RunController;
class Workbench;
struct WindowPages;

/// What the pages that lead elsewhere are connected with.
struct WindowLinks {
  MainWindow& window;
  Workbench& bench;
  DockLayout& layout;
  WindowPages& pages;
  DraftController& drafts;
  RunController& runs;
  GridController& grids;
};

/// The tree of experiments: shows what the watcher tells, and what is asked of its entries is done.
void linkTree(const WindowLinks& to);
/// The doors of the start page.
void linkStartPage(const WindowLinks& to);
/// What the replay's camera follows.
void linkReplay(const WindowLinks& to);
/// The running world: the last game, and the database whose individuals play.
void linkScene(const WindowLinks& to);
/// Files that are dropped on the window go where their content belongs.
void linkDrops(const WindowLinks& to);

}  // namespace btr::ui
