#pragma once
#include <QColor>
#include <QPalette>

namespace btr::ui {

/// Colours of a plot for a light or a dark window. The series colours keep their order, so that a run or a quantity has
/// the same hue in both, and stay apart for people who see red and green alike.
struct PlotColours {
  bool dark = false;
  QColor background, text, faintText, grid, axis, note;

  /// Follows the palette's base colour.
  static PlotColours of(const QPalette& palette);
  /// Dark on white, for paper.
  static PlotColours forPrint();

  QColor series(int index) const;
};

}  // namespace btr::ui
