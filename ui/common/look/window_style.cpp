#include "ui/common/look/window_style.h"

#include <QPainter>
#include <QStyleFactory>
#include <QStyleOption>
#include <algorithm>

namespace btr::ui {
namespace {

// Pixels.
constexpr int headerBeside = 6, headerAbove = 4;   ///< between a heading and its cell
constexpr int titleBeside = 8, titleAbove = 6;     ///< between a dock's title and its bar
constexpr int separator = 5;                       ///< between docks
constexpr int toolBarGap = 3;                      ///< around and between what is on it
constexpr int tipFrame = 5;                        ///< of a tool tip: its line and the room within
constexpr int leastBar = 18;                       ///< height of a progress bar
constexpr double barCorner = 4, filledCorner = 3;  ///< their radii

void lineBelow(QPainter& painter, const QRect& rect, const QColor& colour) {
  painter.fillRect(QRect(rect.left(), rect.bottom(), rect.width(), 1), colour);
}

void drawHeading(QPainter& painter, const QStyleOption& option) {
  painter.fillRect(option.rect, option.palette.window());
  const QRect right(option.rect.right(), option.rect.top(), 1, option.rect.height());
  painter.fillRect(right, option.palette.midlight());
  lineBelow(painter, option.rect, option.palette.mid().color());
}

void drawGroove(QPainter& painter, const QStyleOption& option) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(option.palette.mid().color());
  painter.setBrush(option.palette.base());
  painter.drawRoundedRect(QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5), barCorner, barCorner);
  painter.restore();
}

/// The text of a progress bar has one colour: its filled part suits it.
void drawFilled(QPainter& painter, const QStyleOptionProgressBar& bar, bool dark) {
  const double range = static_cast<double>(bar.maximum) - bar.minimum;
  const double share = std::clamp((static_cast<double>(bar.progress) - bar.minimum) / range, 0.0, 1.0);
  QRectF filled(bar.rect);
  filled.setWidth(share * filled.width());
  if (filled.width() < 1) return;
  if (bar.direction == Qt::RightToLeft) filled.moveRight(bar.rect.right());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(dark ? QColor("#2f66c4") : QColor("#a8c8fa"));
  painter.drawRoundedRect(filled, filledCorner, filledCorner);
  painter.restore();
}

bool isBusy(const QStyleOptionProgressBar& bar) { return bar.maximum <= bar.minimum; }

/// Fusion draws outlines as a darker window colour, which vanishes on a dark window: here they get a lighter one.
template <class Option>
Option outlined(Option option) {
  option.palette.setColor(QPalette::Window, QColor("#77808b"));
  return option;
}

}  // namespace

WindowStyle::WindowStyle(bool dark) : QProxyStyle(QStyleFactory::create(QStringLiteral("Fusion"))), dark_(dark) {}

void WindowStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                const QWidget* widget) const {
  switch (element) {
    case PE_IndicatorDockWidgetResizeHandle:
      painter->fillRect(option->rect, option->state.testFlag(State_MouseOver) ? option->palette.highlight()
                                                                              : option->palette.window());
      return;
    case PE_PanelStatusBar:
      painter->fillRect(QRect(option->rect.topLeft(), QSize(option->rect.width(), 1)), option->palette.mid());
      return;
    case PE_FrameStatusBarItem:
      return;
    case PE_PanelTipLabel:
      painter->fillRect(option->rect, option->palette.toolTipBase());
      painter->setPen(option->palette.mid().color());
      painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
      return;
    case PE_IndicatorCheckBox:
    case PE_IndicatorRadioButton:
    case PE_FrameLineEdit:
    case PE_PanelLineEdit:
    case PE_Frame:
      break;
    default:
      return QProxyStyle::drawPrimitive(element, option, painter, widget);
  }
  const auto draw = [&](const auto& shown) { QProxyStyle::drawPrimitive(element, &shown, painter, widget); };
  if (!dark_) return QProxyStyle::drawPrimitive(element, option, painter, widget);
  if (const auto* button = qstyleoption_cast<const QStyleOptionButton*>(option)) return draw(outlined(*button));
  if (const auto* frame = qstyleoption_cast<const QStyleOptionFrame*>(option)) return draw(outlined(*frame));
  QProxyStyle::drawPrimitive(element, option, painter, widget);
}

void WindowStyle::drawTitle(QPainter& painter, const QStyleOptionDockWidget& dock, const QRect& room) const {
  painter.save();
  QFont bold = painter.font();
  bold.setWeight(QFont::DemiBold);
  painter.setFont(bold);
  const QString text = painter.fontMetrics().elidedText(dock.title, Qt::ElideRight, room.width());
  drawItemText(&painter, room, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextShowMnemonic, dock.palette,
               dock.state.testFlag(State_Enabled), text, QPalette::WindowText);
  painter.restore();
}

void WindowStyle::drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                              const QWidget* widget) const {
  const auto* const bar = qstyleoption_cast<const QStyleOptionProgressBar*>(option);
  switch (element) {
    case CE_DockWidgetTitle:
      if (const auto* dock = qstyleoption_cast<const QStyleOptionDockWidget*>(option);
          dock && !dock->verticalTitleBar) {
        painter->fillRect(dock->rect, dock->palette.window());
        lineBelow(*painter, dock->rect, dock->palette.mid().color());
        drawTitle(*painter, *dock, subElementRect(SE_DockWidgetTitleBarText, dock, widget));
        return;
      }
      break;
    case CE_ToolBar:
      lineBelow(*painter, option->rect, option->palette.mid().color());
      return;
    case CE_HeaderSection:
      drawHeading(*painter, *option);
      return;
    case CE_HeaderEmptyArea:
      painter->fillRect(option->rect, option->palette.window());
      return;
    case CE_ProgressBarGroove:
      drawGroove(*painter, *option);
      return;
    case CE_ProgressBarContents:
      if (!bar || isBusy(*bar)) break;
      drawFilled(*painter, *bar, dark_);
      return;
    case CE_ProgressBarLabel:
      if (bar && bar->textVisible)
        drawItemText(painter, bar->rect, Qt::AlignCenter | Qt::TextSingleLine, bar->palette,
                     bar->state.testFlag(State_Enabled), bar->text, QPalette::Text);
      return;
    default:
      break;
  }
  QProxyStyle::drawControl(element, option, painter, widget);
}

void WindowStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                                     const QWidget* widget) const {
  const auto draw = [&](const auto& shown) { QProxyStyle::drawComplexControl(control, &shown, painter, widget); };
  if (!dark_) return QProxyStyle::drawComplexControl(control, option, painter, widget);
  if (const auto* spin = qstyleoption_cast<const QStyleOptionSpinBox*>(option)) return draw(outlined(*spin));
  if (const auto* combo = qstyleoption_cast<const QStyleOptionComboBox*>(option)) return draw(outlined(*combo));
  QProxyStyle::drawComplexControl(control, option, painter, widget);
}

int WindowStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
  switch (metric) {
    case PM_DockWidgetTitleMargin:
      return titleAbove;
    case PM_DockWidgetSeparatorExtent:
      return separator;
    case PM_ToolBarFrameWidth:
      return 0;
    case PM_ToolBarItemMargin:
    case PM_ToolBarItemSpacing:
      return toolBarGap;
    case PM_HeaderMargin:
      return headerAbove;
    case PM_ToolTipLabelFrameWidth:
      return tipFrame;
    default:
      return QProxyStyle::pixelMetric(metric, option, widget);
  }
}

QRect WindowStyle::subElementRect(SubElement element, const QStyleOption* option, const QWidget* widget) const {
  QRect rect = QProxyStyle::subElementRect(element, option, widget);
  switch (element) {
    case SE_DockWidgetTitleBarText:
      rect.setLeft(std::max(rect.left(), option->rect.left() + titleBeside));
      return rect;
    case SE_ProgressBarGroove:
    case SE_ProgressBarLabel:
      return option->rect;
    case SE_ProgressBarContents:
      return option->rect.adjusted(1, 1, -1, -1);
    default:
      return rect;
  }
}

QSize WindowStyle::sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& contents,
                                    const QWidget* widget) const {
  const QSize size = QProxyStyle::sizeFromContents(type, option, contents, widget);
  switch (type) {
    case CT_HeaderSection:
      return size + QSize(2 * (headerBeside - headerAbove), 0);
    case CT_ProgressBar:
      return size.expandedTo(QSize(0, leastBar));
    default:
      return size;
  }
}

}  // namespace btr::ui
