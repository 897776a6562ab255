#include "ui/charts/plot_colours.h"

#include <array>

namespace btr::ui {
namespace {

constexpr std::array onLight{0x0b6bb3, 0xd1541a, 0x15825e, 0x8a4fbe, 0xb07700, 0x2f97cc, 0xb83a7a, 0x6b6f76};
constexpr std::array onDark{0x5bb0f0, 0xff9060, 0x4fcf9f, 0xc49bf0, 0xf0c050, 0x8fd6ff, 0xf58fbf, 0xb2b7bd};

QColor mixed(const QColor& a, const QColor& b, double share) {
  return QColor::fromRgbF(static_cast<float>(a.redF() * (1 - share) + b.redF() * share),
                          static_cast<float>(a.greenF() * (1 - share) + b.greenF() * share),
                          static_cast<float>(a.blueF() * (1 - share) + b.blueF() * share));
}

PlotColours from(const QColor& background, const QColor& text) {
  PlotColours colours;
  colours.dark = background.lightness() < 128;
  colours.background = background;
  colours.text = text;
  colours.faintText = mixed(background, text, 0.68);
  colours.grid = mixed(background, text, 0.12);
  colours.axis = mixed(background, text, 0.45);
  colours.note = colours.dark ? QColor(0xffb454) : QColor(0xa85b00);
  return colours;
}

}  // namespace

PlotColours PlotColours::of(const QPalette& palette) {
  return from(palette.color(QPalette::Base), palette.color(QPalette::Text));
}

PlotColours PlotColours::forPrint() { return from(Qt::white, QColor(0x1c1f23)); }

QColor PlotColours::series(int index) const {
  const auto& list = dark ? onDark : onLight;
  return QColor(static_cast<QRgb>(list[static_cast<std::size_t>(index) % list.size()]));
}

}  // namespace btr::ui
