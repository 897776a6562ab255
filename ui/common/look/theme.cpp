#include "ui/common/look/theme.h"

#include <QApplication>
#include <QPainter>
#include <QPixmap>
#include <QToolTip>
#include <QWidget>

#include "ui/common/look/window_style.h"

namespace btr::ui {
namespace {

struct Colours {
  const char *window, *base, *alternate, *text, *button, *disabled, *highlight, *highlighted, *link, *light, *midlight,
      *mid, *dark, *shadow, *tip;
};

constexpr Colours lightColours{"#eef0f3", "#ffffff", "#f5f7f9", "#1f2429", "#f7f8fa", "#9aa2ab", "#2f6fdb", "#ffffff",
                               "#1f5fc4", "#ffffff", "#e3e6ea", "#c5cad1", "#a5acb5", "#767d86", "#ffffff"};
constexpr Colours darkColours{"#23272c", "#1a1d21", "#20242a", "#dfe3e8", "#2d3239", "#737c87", "#2f66c4", "#ffffff",
                              "#7fb0ff", "#3c434c", "#343a42", "#30353c", "#15181b", "#0c0e10", "#2d3239"};

QPalette paletteFrom(const Colours& c) {
  QPalette palette;
  palette.setColor(QPalette::Window, c.window);
  palette.setColor(QPalette::WindowText, c.text);
  palette.setColor(QPalette::Base, c.base);
  palette.setColor(QPalette::AlternateBase, c.alternate);
  palette.setColor(QPalette::Text, c.text);
  palette.setColor(QPalette::Button, c.button);
  palette.setColor(QPalette::ButtonText, c.text);
  palette.setColor(QPalette::BrightText, "#ffffff");
  palette.setColor(QPalette::ToolTipBase, c.tip);
  palette.setColor(QPalette::ToolTipText, c.text);
  palette.setColor(QPalette::PlaceholderText, c.disabled);
  palette.setColor(QPalette::Highlight, c.highlight);
  palette.setColor(QPalette::HighlightedText, c.highlighted);
  palette.setColor(QPalette::Link, c.link);
  palette.setColor(QPalette::LinkVisited, c.link);
  palette.setColor(QPalette::Light, c.light);
  palette.setColor(QPalette::Midlight, c.midlight);
  palette.setColor(QPalette::Mid, c.mid);
  palette.setColor(QPalette::Dark, c.dark);
  palette.setColor(QPalette::Shadow, c.shadow);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, c.disabled);
  palette.setColor(QPalette::Disabled, QPalette::Highlight, c.mid);
  palette.setColor(QPalette::Disabled, QPalette::HighlightedText, c.disabled);
  return palette;
}

}  // namespace

QString nameOf(Look look) {
  return look == Look::light  ? QStringLiteral("light")
         : look == Look::dark ? QStringLiteral("dark")
                              : QStringLiteral("system");
}

Look lookFromText(const QString& text) {
  return text == "light" ? Look::light : text == "dark" ? Look::dark : Look::system;
}

Theme::Theme(QApplication& application, QObject* parent)
    : QObject(parent),
      application_(application),
      systemIsDark_(application.palette().color(QPalette::Window).lightness() < 128) {
  QIcon::setThemeSearchPaths(QIcon::themeSearchPaths() << QStringLiteral("/usr/share/icons"));
}

void Theme::apply(Look look) {
  look_ = look;
  dark_ = look == Look::dark || (look == Look::system && systemIsDark_);
  // Icons first: whoever hears of the new palette asks for its icons again.
  QIcon::setThemeName(dark_ ? QStringLiteral("breeze-dark") : QStringLiteral("breeze"));
  application_.setStyle(new WindowStyle(dark_));
  const QPalette palette = paletteFrom(dark_ ? darkColours : lightColours);
  application_.setPalette(palette);
  QToolTip::setPalette(palette);
  // Widgets hear of it only later, and what has a style sheet of its own keeps the palette that it had.
  QCoreApplication::sendPostedEvents(nullptr, QEvent::ApplicationPaletteChange);
  for (QWidget* widget : QApplication::allWidgets())
    if (const QString sheet = widget->styleSheet(); !sheet.isEmpty()) {
      widget->setStyleSheet(QString());
      widget->setStyleSheet(sheet);
    }
  emit changed();
}

Tones tonesOf(const QPalette& palette) {
  if (palette.color(QPalette::Window).lightness() < 128)
    return {QColor("#57c17b"), QColor("#e5a83b"), QColor("#ff7b72"),
            QColor("#c792ea"), QColor("#8d97a3"), QColor("#7fb0ff")};
  return {QColor("#1a7f37"), QColor("#9a6400"), QColor("#c62828"),
          QColor("#7b3fb5"), QColor("#68717b"), QColor("#1f5fc4")};
}

QIcon themeIcon(const QString& name) {
  const QIcon icon = QIcon::fromTheme(name);
  if (!icon.isNull()) return icon;
  QPixmap drawn(32, 32);
  drawn.fill(Qt::transparent);
  QPainter painter(&drawn);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor("#8d97a3"), 2));
  painter.drawRoundedRect(QRectF(3, 3, 26, 26), 6, 6);
  QFont font = painter.font();
  font.setPixelSize(18);
  painter.setFont(font);
  painter.drawText(drawn.rect(), Qt::AlignCenter, name.left(1).toUpper());
  return drawn;
}

}  // namespace btr::ui
