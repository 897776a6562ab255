#pragma once
#include <QProxyStyle>
#include <QStyleOptionDockWidget>

namespace btr::ui {

/// How this program's widgets look: Fusion with docks, tool bars, headers and progress bars a little calmer, in colours
/// of the palette, so that the light and the dark look share it. No style sheet of the application does that: with one
/// Qt looks up the rules of each widget anew whenever it changes its parent, which took half of the time in which the
/// window was made.
class WindowStyle final : public QProxyStyle {
 public:
  explicit WindowStyle(bool dark);

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget) const override;
  void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                          const QWidget* widget) const override;
  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override;
  QRect subElementRect(SubElement element, const QStyleOption* option, const QWidget* widget) const override;
  QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& contents,
                         const QWidget* widget) const override;

 private:
  void drawTitle(QPainter& painter, const QStyleOptionDockWidget& dock, const QRect& room) const;

  bool dark_;
};

}  // namespace btr::ui
