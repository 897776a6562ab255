#pragma once
#include <QWidget>

#include "ui/live/drawn/live_view.h"
#include "ui/live/drawn/view_mode.h"

class QComboBox;

namespace btr::ui {
class LiveWorld;

/// A further 3D view of the running world: free, following an object, aboard of
/// it, or from the top. Borrows the world.
class ExtraView : public QWidget {
  Q_OBJECT
 public:
  explicit ExtraView(LiveWorld& world, QWidget* parent = nullptr);

  LiveView& view() { return *view_; }
  ViewMode mode() const;
  void setMode(ViewMode mode);
  QString object() const;
  void setObject(const QString& name);

  /// Camera, mode and object, for a game file.
  nlohmann::json state() const;
  void restore(const nlohmann::json& state);

 private:
  void fillObjects();
  void showRow();

  LiveWorld& world_;
  LiveView* view_;
  QComboBox *mode_, *object_;
  QString wanted_;  ///< object that a restored view has and that is not there yet
};

}  // namespace btr::ui
