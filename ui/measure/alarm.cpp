#include "ui/measure/alarm.h"

#include <QApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>

#include "ui/common/look/theme.h"
#include "ui/common/settings.h"
#include "ui/measure/alarm_sound.h"

namespace btr::ui {
namespace {
constexpr int chimeEvery_ms = 4000, chimesAtMost = 30;
constexpr auto mutedFlag = "alarmMuted";
/// Its icon suits the look, also when that changes.
class Bell final : public QLabel {
 public:
  explicit Bell(QWidget* parent) : QLabel(parent) { draw(); }

 protected:
  void changeEvent(QEvent* event) override {
    if (event->type() == QEvent::PaletteChange) draw();
    QLabel::changeEvent(event);
  }

 private:
  void draw() { setPixmap(themeIcon("appointment-reminder").pixmap(22, 22)); }
};

}  // namespace

Alarm::Alarm(QWidget* parent, const QString& settingsFile, std::function<void()> play)
    : QFrame(parent),
      muted_(Settings(settingsFile).flag(mutedFlag, false)),
      settingsFile_(settingsFile),
      play_(std::move(play)) {
  if (!play_) {
    auto* sound = new AlarmSound(this);
    play_ = [sound] { sound->play(); };
    stop_ = [sound] { sound->stop(); };
  }
  setAccessibleName(tr("Alarm"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 2, 4, 2);
  auto* icon = new Bell(this);
  text_ = new QLabel(this);
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont bold = text_->font();
  bold.setBold(true);
  text_->setFont(bold);
  text_->setMinimumWidth(fontMetrics().horizontalAdvance('x') * 24);
  text_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
  auto* show = new QPushButton(tr("Open the sheet"), this);
  silence_ = new QPushButton(tr("Silence"), this);
  silence_->setToolTip(tr("Stops sound and pulsing; the message stays until everything is measured"));
  mute_ = new QToolButton(this);
  mute_->setCheckable(true);
  mute_->setChecked(muted_);
  mute_->setAutoRaise(true);
  mute_->setIcon(themeIcon("audio-volume-muted"));
  mute_->setToolTip(tr("No alarm sound, in later sessions too"));
  mute_->setAccessibleName(tr("Mute alarm sounds"));
  layout->addWidget(icon);
  layout->addWidget(text_, 1);
  layout->addWidget(show);
  layout->addWidget(silence_);
  layout->addWidget(mute_);

  connect(show, &QPushButton::clicked, this, [this] {
    silence();
    emit sheetRequested();
  });
  connect(silence_, &QPushButton::clicked, this, &Alarm::silence);
  connect(mute_, &QToolButton::toggled, this, &Alarm::setMuted);
  repeat_.setInterval(chimeEvery_ms);
  connect(&repeat_, &QTimer::timeout, this, &Alarm::sound);
  pulse_.setStartValue(0.0);
  pulse_.setKeyValueAt(0.5, 1.0);
  pulse_.setEndValue(0.0);
  pulse_.setDuration(1400);
  pulse_.setLoopCount(-1);
  connect(&pulse_, &QVariantAnimation::valueChanged, this, qOverload<>(&QWidget::update));
  hide();
}

Alarm::~Alarm() = default;

QString Alarm::message() const { return text_->text(); }

void Alarm::raiseAlarm(const QString& message) {
  if (state_ != State::quiet && message == text_->text()) return;
  text_->setText(message);
  text_->setToolTip(message);
  setAccessibleDescription(message);
  chimes_ = 0;
  setState(State::ringing);
  QApplication::alert(window());
  sound();
}

void Alarm::silence() {
  if (state_ == State::ringing) setState(State::silenced);
}

void Alarm::clear() { setState(State::quiet); }

void Alarm::setMuted(bool muted) {
  if (muted == muted_) return;
  muted_ = muted;
  mute_->setChecked(muted);
  Settings(settingsFile_).setFlag(mutedFlag, muted);
  if (muted && stop_) stop_();
  if (!muted && state_ == State::ringing) sound();
}

void Alarm::sound() {
  // A person who is away for an hour need not hear it all the time; the banner goes on.
  if (state_ != State::ringing || ++chimes_ > chimesAtMost) return repeat_.stop();
  if (!muted_) play_();
}

void Alarm::setState(State state) {
  state_ = state;
  setVisible(state != State::quiet);
  silence_->setVisible(state == State::ringing);
  if (state == State::ringing) {
    repeat_.start();
    pulse_.start();
  } else {
    repeat_.stop();
    pulse_.stop();
    if (stop_) stop_();
  }
  update();
  emit stateChanged();
}

void Alarm::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QColor colour = tonesOf(palette()).warning;
  const double strength = state_ == State::ringing ? pulse_.currentValue().toDouble() : 0;
  colour.setAlphaF(static_cast<float>(0.16 + 0.34 * strength));
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.fillRect(rect(), colour);
  colour.setAlphaF(1);
  painter.fillRect(QRect(0, 0, 5, height()), colour);
  painter.fillRect(QRect(0, height() - 1, width(), 1), colour);
}

}  // namespace btr::ui
