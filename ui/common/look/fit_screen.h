#pragma once
#include <QSize>

class QWidget;

namespace btr::ui {

/// Gives a window that size or, where its screen is smaller, what the screen has room for beside a frame: its buttons
/// can be reached on a small screen, too.
void resizeWithinScreen(QWidget& window, QSize wanted);

}  // namespace btr::ui
