#pragma once
#include <QColor>

namespace btr::ui {

/// Dark blue over green to yellow for a share of 0 … 1; brightness rises evenly, so that it also reads in grey.
QColor rampColour(double share);
/// Black or white, whichever is read better on a colour.
QColor textOn(const QColor& colour);

}  // namespace btr::ui
