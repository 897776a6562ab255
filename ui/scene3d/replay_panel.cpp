#include "ui/scene3d/replay_panel.h"

#include <QAction>
#include <QBoxLayout>
#include <QComboBox>
#include <QKeyEvent>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>
#include <QToolButton>
#include <algorithm>

#include "core/spec/error.h"
#include "ui/common/look/cut_label.h"
#include "ui/common/numbers/format.h"
#include "ui/scene3d/replay_job.h"

namespace btr::ui {
namespace {

QString seconds(double time_s) { return QLocale::c().toString(time_s, 'f', 3); }

/// Both numbers with as many digits as it takes to tell them apart.
std::pair<QString, QString> distinct(double a, double b, const QString& unit) {
  for (int digits : {4, 6, 9, 17}) {
    const auto text = [&](double value) { return QLocale::c().toString(value, 'g', digits); };
    if (text(a) != text(b) || digits == 17) {
      const QString ending = unit.isEmpty() ? QString() : " " + unit;
      return {text(a) + ending, text(b) + ending};
    }
  }
  return {};
}

}  // namespace

Badge checkBadge(const ReplayData& data) {
  switch (data.check) {
    case ReplayData::Check::identical:
      return {ReplayPanel::tr("identical to the stored run"), Badge::Tone::good};
    case ReplayData::Check::differs: {
      const auto [stored, now] = distinct(data.storedFitness, data.fitness, data.fitnessUnit);
      if (data.fitnessHidden) return {ReplayPanel::tr("differs from the stored run"), Badge::Tone::bad};
      if (data.storedFitness == data.fitness)
        return {ReplayPanel::tr("differs from the stored run: fitness %1 in both, motion differs").arg(stored),
                Badge::Tone::bad};
      return {ReplayPanel::tr("differs from the stored run: stored %1, now %2").arg(stored, now), Badge::Tone::bad};
    }
    case ReplayData::Check::notChecked:
      return {ReplayPanel::tr("not checked against a stored run"), Badge::Tone::neutral};
  }
  return {};
}

QList<Badge> badgesOf(const ReplayData& data) {
  QList<Badge> badges{checkBadge(data)};
  if (data.standIn) badges << Badge{ReplayPanel::tr("stand-in reality, not a robot"), Badge::Tone::standIn};
  const auto isDrawn = [](const Link& link) { return std::ranges::any_of(link.shapes, &Shape::drawn); };
  if (data.model && std::ranges::none_of(data.model->links, isDrawn))
    badges << Badge{ReplayPanel::tr("the robot's model has no shapes to draw"), Badge::Tone::warning};
  return badges;
}

const std::vector<double>& ReplayPanel::speeds() {
  static const std::vector<double> values{0.1, 0.25, 0.5, 1, 2, 4};
  return values;
}

ReplayPanel::ReplayPanel(QWidget* parent, GlContextFactory factory)
    : QWidget(parent), factory_(std::move(factory)), view_(new SceneView(this, factory_)) {
  result_ = new CutLabel(this);
  result_->setObjectName("result");
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  result_->setFocusPolicy(Qt::NoFocus);

  auto* head = new QHBoxLayout;
  head->addWidget(result_, 1);
  for (QAction* action : view_->viewActions()) {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    if (action->menu()) button->setPopupMode(QToolButton::InstantPopup);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::TabFocus);
    button->setToolButtonStyle(action->icon().isNull() ? Qt::ToolButtonTextOnly : Qt::ToolButtonIconOnly);
    head->addWidget(button);
  }
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(4, 4, 4, 4);
  all->setSpacing(4);
  all->addLayout(head);
  views_ = new QHBoxLayout;
  views_->addWidget(view_, 1);
  all->addLayout(views_, 1);
  all->addLayout(makeTransport());

  timer_.setInterval(16);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, [this] { advance(since_.restart() * 1e-3); });
  setFocusProxy(view_);
  showMessage(tr("Choose an individual to replay it here."));
}

ReplayPanel::~ReplayPanel() = default;

QLayout* ReplayPanel::makeTransport() {
  const auto make = [this](const QString& name, const QString& icon, QStyle::StandardPixmap otherwise,
                           const QString& hint) {
    auto* button = new QToolButton(this);
    button->setIcon(QIcon::fromTheme(icon, style()->standardIcon(otherwise)));
    button->setToolTip(hint);
    button->setAccessibleName(name);
    button->setFocusPolicy(Qt::TabFocus);
    button->setAutoRaise(true);
    return button;
  };
  first_ = make(tr("First frame"), "media-skip-backward", QStyle::SP_MediaSkipBackward, tr("First frame (Home)"));
  back_ = make(tr("One frame back"), "media-seek-backward", QStyle::SP_MediaSeekBackward, tr("One frame back (←)"));
  play_ = make(tr("Play"), "media-playback-start", QStyle::SP_MediaPlay, tr("Play or pause (Space)"));
  forward_ = make(tr("One frame on"), "media-seek-forward", QStyle::SP_MediaSeekForward, tr("One frame on (→)"));
  loop_ = make(tr("Loop"), "media-playlist-repeat", QStyle::SP_BrowserReload, tr("Begin again at the end (L)"));
  loop_->setCheckable(true);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setAccessibleName(tr("Frame of the replay"));
  slider_->setPageStep(10);
  slider_->setToolTip(tr("Drag to any moment of the trial"));
  time_ = new QLabel(this);
  time_->setAccessibleName(tr("Time of the replay in s"));
  time_->setToolTip(tr("Simulated time and end of the trial, in s"));
  speed_ = new QComboBox(this);
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Simulated seconds shown per second"));
  for (double speed : speeds()) speed_->addItem(QLocale::c().toString(speed) + "×", speed);
  speed_->setCurrentIndex(speed_->findData(1.0));

  connect(first_, &QToolButton::clicked, this, [this] { showFrame(0); });
  connect(back_, &QToolButton::clicked, this, [this] { step(-1); });
  connect(play_, &QToolButton::clicked, this, [this] { setPlaying(!playback_.playing()); });
  connect(forward_, &QToolButton::clicked, this, [this] { step(1); });
  connect(loop_, &QToolButton::toggled, this, [this](bool on) { playback_.setLooping(on); });
  connect(slider_, &QSlider::valueChanged, this, [this](int frame) { showFrame(static_cast<std::size_t>(frame)); });
  connect(slider_, &QSlider::sliderReleased, this, &ReplayPanel::refresh);
  connect(speed_, &QComboBox::currentIndexChanged, this, [this] {
    playback_.setSpeed(speed_->currentData().toDouble());
    refreshCaption();
  });

  auto* bar = new QHBoxLayout;
  for (QToolButton* button : {first_, back_, play_, forward_, loop_}) bar->addWidget(button);
  bar->addWidget(slider_, 1);
  bar->addWidget(time_);
  bar->addWidget(speed_);
  return bar;
}

void ReplayPanel::setReplay(const ReplayData& replay) {
  try {
    frames_ = ReplayFrames(replay);
    besideFrames_ = replay.beside ? ReplayFrames(*replay.beside) : ReplayFrames();
  } catch (const InputError& error) {
    return showMessage(QString::fromUtf8(error.what()), Badge::Tone::bad);
  }
  data_ = replay;
  ghosts_.clear();
  playback_.setTimes(frames_.times());
  view_->setGround(replay.ground);
  view_->setRobot(replay.model);
  view_->setFurtherRobots(frames_.otherModels());
  view_->setBalls(frames_.ballRadii());
  showBeside(replay.beside.get());
  QStringList result;
  if (!replay.title.isEmpty()) result << replay.title;
  if (replay.fitnessHidden)
    result << tr("fitness hidden");
  else if (replay.check != ReplayData::Check::notChecked || replay.fitness != 0)
    result << tr("fitness %1").arg(withUnit(replay.fitness, replay.fitnessUnit));
  if (!replay.simulator.isEmpty()) result << replay.simulator;
  if (!replay.note.isEmpty()) result << replay.note;
  result_->setWhole(result.join("  ·  "));
  view_->setBadges(badgesOf(replay));
  slider_->setRange(0, std::max(0, int(playback_.frames()) - 1));
  setPlaying(false);
  refresh();
}

// A second trial stands in a view of its own, seen from the same place.
void ReplayPanel::showBeside(const ReplayData* other) {
  if (!other) {
    if (beside_) beside_->hide();
    return;
  }
  if (!beside_) {
    beside_ = new SceneView(this, factory_);
    beside_->setObjectName("beside");
    // One of them leads.
    beside_->setKeepingInView(false);
    connect(beside_, &SceneView::panned, view_, [this] { view_->setKeepingInView(false); });
    views_->addWidget(beside_, 1);
    const auto link = [this](SceneView* from, SceneView* to) {
      connect(from, &SceneView::cameraChanged, to, [from, to] {
        const QSignalBlocker quiet(to);
        to->setCamera(from->camera());
      });
    };
    link(view_, beside_);
    link(beside_, view_);
  }
  beside_->setGround(other->ground);
  beside_->setRobot(other->model);
  beside_->setFurtherRobots(besideFrames_.otherModels());
  beside_->setBalls(besideFrames_.ballRadii());
  beside_->setBadges(badgesOf(*other));
  beside_->setCamera(view_->camera());
  beside_->show();
}

void ReplayPanel::setGhosts(const std::vector<GhostReplay>& ghosts) {
  ghosts_.clear();
  for (const GhostReplay& ghost : ghosts) ghosts_.emplace_back(ReplayFrames(ghost.data), ghost.colour);
  refresh();
}

void ReplayPanel::showMessage(const QString& text, Badge::Tone tone) {
  data_ = {};
  frames_ = {};
  ghosts_.clear();
  playback_.setTimes({});
  view_->setGhosts({});
  view_->setRobot(nullptr);
  view_->setFurtherRobots({});
  view_->setBalls({});
  showBeside(nullptr);
  view_->setCaption({});
  view_->setBadges({Badge{text, tone}});
  result_->setWhole({});
  slider_->setRange(0, 0);
  setPlaying(false);
  refresh();
}

void ReplayPanel::attach(ReplayJob& job) {
  connect(&job, &ReplayJob::started, this, [this] { showMessage(tr("Running the trial again …")); });
  connect(&job, &ReplayJob::finished, this, [this](const ReplayData& replay) {
    setReplay(replay);
    setPlaying(playback_.frames() > 0);  // what was asked for is seen moving
  });
  connect(&job, &ReplayJob::failed, this, [this](const QString& reason) { showMessage(reason, Badge::Tone::bad); });
}

void ReplayPanel::setPlaying(bool playing) {
  playback_.setPlaying(playing);
  refresh();
}

void ReplayPanel::setSpeed(double speed) {
  const int index = speed_->findData(speed);
  if (index >= 0) speed_->setCurrentIndex(index);
}

void ReplayPanel::advance(double elapsed_s) {
  playback_.advance(elapsed_s);
  refresh();
}

void ReplayPanel::step(int frames) {
  playback_.step(frames);
  refresh();
}

void ReplayPanel::showFrame(std::size_t frame) {
  playback_.showFrame(frame);
  refresh();
}

void ReplayPanel::showTime(double time_s) {
  if (playback_.frames() == 0) return;
  playback_.showTime(time_s);
  refresh();
}

/// Brings view, slider, button and timer to where the playback stands.
void ReplayPanel::refresh() {
  const bool playing = playback_.playing(), any = playback_.frames() > 0;
  if (playing && !timer_.isActive()) {
    since_.start();
    timer_.start();
  } else if (!playing) {
    timer_.stop();
  }
  view_->setMoving(playing || slider_->isSliderDown());
  play_->setIcon(playing ? QIcon::fromTheme("media-playback-pause", style()->standardIcon(QStyle::SP_MediaPause))
                         : QIcon::fromTheme("media-playback-start", style()->standardIcon(QStyle::SP_MediaPlay)));
  play_->setAccessibleName(playing ? tr("Pause") : tr("Play"));
  for (QWidget* control : std::initializer_list<QWidget*>{first_, back_, play_, forward_, loop_, slider_, speed_})
    control->setEnabled(any);
  {
    const QSignalBlocker quiet(slider_);
    slider_->setValue(static_cast<int>(playback_.frame()));
  }
  if (any) {
    view_->setPose(frames_.pose(playback_.frame()));
    if (isBeside()) {
      Playback at;
      at.setTimes(besideFrames_.times());
      at.showTime(playback_.timeOf(playback_.frame()));
      beside_->setMoving(playing || slider_->isSliderDown());
      beside_->setPose(besideFrames_.pose(at.frame()));
    }
    std::vector<Ghost> shown;
    for (const auto& [frames, colour] : ghosts_) {
      Playback at;
      at.setTimes(frames.times());
      if (at.frames() == 0) continue;
      at.showTime(playback_.timeOf(playback_.frame()));
      shown.push_back({frames.pose(at.frame()), colour});
    }
    view_->setGhosts(std::move(shown));
    emit timeChanged(playback_.timeOf(playback_.frame()));
  }
  refreshCaption();
}

void ReplayPanel::refreshCaption() {
  if (playback_.frames() == 0) {
    time_->setText(tr("– s"));
    return;
  }
  const double now = playback_.timeOf(playback_.frame());
  time_->setText(tr("%1 / %2 s").arg(seconds(now), seconds(playback_.end())));
  QStringList lines;
  if (!data_.title.isEmpty()) lines << data_.title;
  lines << tr("t = %1 s, %2×").arg(seconds(now), QLocale::c().toString(playback_.speed()));
  if (data_.rollsFrom_s >= 0 && now > data_.rollsFrom_s) lines << tr("the ball rolls out, by formula");
  view_->setCaption(lines);
  if (isBeside()) beside_->setCaption({data_.beside->title, lines.value(1)});
}

void ReplayPanel::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Space:
      return setPlaying(!playback_.playing());
    case Qt::Key_Left:
      return step(-1);
    case Qt::Key_Right:
      return step(1);
    case Qt::Key_Home:
      return showFrame(0);
    case Qt::Key_End:
      return showFrame(playback_.frames());
    case Qt::Key_L:
      return loop_->toggle();
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace btr::ui
