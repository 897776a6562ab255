#pragma once
#include <QObject>
#include <QSize>

class QMainWindow;

namespace btr::ui {
class DockLayout;
class Settings;

/// Where the window stands and how large it is: as it was left, or as large as the screen lets it, never off the
/// screen.
class WindowPlace : public QObject {
  Q_OBJECT
 public:
  WindowPlace(QMainWindow& window, DockLayout& layout, Settings& settings);
  /// As the window was left, docks too.
  void restore();
  /// The first size and the first places of the docks.
  void reset();
  void keep();  ///< for the next start

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void bringOnScreen();
  QSize defaultSize() const;

  QMainWindow& window_;
  DockLayout& layout_;
  Settings& settings_;
};

}  // namespace btr::ui
