#pragma once
#include <QColor>
#include <QIcon>
#include <QObject>
#include <QPalette>

class QApplication;

namespace btr::ui {

enum class Look { system, light, dark };
QString nameOf(Look look);
Look lookFromText(const QString& text);  ///< anything else is system

/// Fusion with our own light and dark palettes and Breeze icons. One lives as long as the application; `system` follows
/// the palette that the desktop gave the application before the first apply().
class Theme : public QObject {
  Q_OBJECT
 public:
  explicit Theme(QApplication& application, QObject* parent = nullptr);
  void apply(Look look);
  Look look() const { return look_; }
  bool dark() const { return dark_; }

 signals:
  void changed();

 private:
  QApplication& application_;
  bool systemIsDark_;
  Look look_ = Look::system;
  bool dark_ = false;
};

/// Colours with a meaning, readable on the palette's window and base colour.
struct Tones {
  QColor good, warning, bad, standIn, muted, accent;
};
Tones tonesOf(const QPalette& palette);

/// The Breeze icon of that name, else a drawn fallback with the first letter, so that no button is ever blank.
QIcon themeIcon(const QString& name);

}  // namespace btr::ui
