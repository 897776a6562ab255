#pragma once
#include <QFrame>
#include <QTimer>
#include <QVariantAnimation>
#include <functional>

class QLabel;
class QPushButton;
class QToolButton;

namespace btr::ui {

/// Calls a person: a banner with pulsing colour, the window's entry in the task bar, and a chime every few seconds for
/// at most two minutes. For the main window, beside its tools, so that it is seen whatever page is open.
class Alarm : public QFrame {
  Q_OBJECT

 public:
  enum class State {
    quiet,    ///< nothing to do; the banner is hidden
    ringing,  ///< the banner pulses; it sounds unless muted
    silenced  ///< the banner stays, steady and silent
  };

  /// Whether it is muted is remembered in `settingsFile` (empty: the user's own settings). `play` replaces the sound.
  explicit Alarm(QWidget* parent = nullptr, const QString& settingsFile = {}, std::function<void()> play = {});
  ~Alarm() override;

  /// Rings, unless the same message was silenced and not cleared since.
  void raiseAlarm(const QString& message);
  void silence();
  void clear();
  State state() const { return state_; }
  QString message() const;
  /// Its height in pixels: two lines of this font.
  static int height_px(const QFontMetrics& font) { return 2 * font.lineSpacing() + 8; }

  /// No sound from now on, in later sessions too; banner and task bar stay.
  void setMuted(bool muted);
  bool isMuted() const { return muted_; }

 signals:
  /// "Show the sheet" was pressed.
  void sheetRequested();
  void stateChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void setState(State state);
  void sound();

  State state_ = State::quiet;
  bool muted_ = false;
  int chimes_ = 0;
  QString settingsFile_;
  std::function<void()> play_, stop_;
  QTimer repeat_;
  QVariantAnimation pulse_;
  QLabel* text_;
  QPushButton* silence_;
  QToolButton* mute_;
};

}  // namespace btr::ui
