#pragma once
#include <QWidget>

namespace btr::ui {

/// Gives a widget another style sheet. Qt polishes it and all that is in it anew whenever one is set, even the same.
inline void styleOnce(QWidget& widget, const QString& sheet) {
  if (widget.styleSheet() != sheet) widget.setStyleSheet(sheet);
}

}  // namespace btr::ui
