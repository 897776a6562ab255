#pragma once
#include <QMap>
#include <QObject>

class QDockWidget;
class QMainWindow;

namespace btr::ui {

/// Where the window's docks stand: their first places, a page that takes the room of all others for a while, and what
/// is remembered between two starts. Docks are known by their names ("fitness" is the object "dock.fitness").
class DockLayout : public QObject {
  Q_OBJECT
 public:
  explicit DockLayout(QMainWindow& window);

  QDockWidget* add(const QString& name, const QString& title, const QString& icon, QWidget* content);
  /// A dock that has the window for itself while it is shown, with `beside` of the others.
  QDockWidget* addPage(const QString& name, const QString& title, const QString& icon, QWidget* content,
                       const QStringList& beside);
  QDockWidget* dock(const QString& name) const;
  bool isPage(const QDockWidget* dock) const;

  /// Every dock back to its first place and size, for a window of its present size.
  void arrange();
  /// Shows a page, or with an empty name the runs' docks as they were.
  void showPage(const QString& name);
  QString page() const { return page_; }
  /// To the front; leaves a page that has no room for it.
  void raise(const QString& name);
  /// Whether the user can see it: shown, and not behind another tab.
  static bool isInFront(const QDockWidget* dock);

  QByteArray state() const;
  bool restore(const QByteArray& state);
  /// Something is about to take room above the docks: a run that is all in sight stays so.
  void keepRunInSight();
  /// Sizes hold only in a window that has its own size: called when it is first shown.
  void sizeOnce();

 signals:
  void pageChanged(const QString& name);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QList<QDockWidget*> all() const;
  void place();
  void placeCompact();
  void placeNarrow();
  void size();
  void sizePage();
  int runHeight(int width) const;
  void growRun();
  QStringList shownWith(const QString& page) const;
  bool isCompact() const;
  bool isNarrow() const;

  QMainWindow& window_;
  QMap<QString, QStringList> pages_;  ///< and what stands beside each
  QString page_;
  QByteArray before_;   ///< the runs' docks while a page has the window
  bool sized_ = false;  ///< the docks have got their sizes
  int runHeight_ = 0;   ///< the most that the run's text has asked for since then
};

}  // namespace btr::ui
