#include "ui/common/look/fit_screen.h"

#include <QScreen>
#include <QWidget>

namespace btr::ui {

void resizeWithinScreen(QWidget& window, QSize wanted) {
  constexpr QSize frame{16, 44};  // before it is shown nobody says how wide it is
  if (const QScreen* screen = window.screen()) wanted = wanted.boundedTo(screen->availableGeometry().size() - frame);
  window.resize(wanted);
}

}  // namespace btr::ui
