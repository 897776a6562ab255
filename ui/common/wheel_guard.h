#pragma once
#include <QObject>

namespace btr::ui {

/// The wheel scrolls a form, whatever lies under it: inside a scroll area it never changes a combo box, a spin box or a
/// slider, with or without the focus. One guard serves the whole program.
class WheelGuard : public QObject {
  Q_OBJECT
 public:
  /// Installs the guard if it is not there yet; every form calls this. Nothing without an application.
  static void ensure();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  explicit WheelGuard(QObject* parent);
};

}  // namespace btr::ui
