#include "ui/live/panels/replay_bar.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/common/look/short_label.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/decimal_spin_box.h"
#include "ui/live/panels/act_timeline.h"

namespace btr::ui {

ReplayBar::ReplayBar(QWidget* parent)
    : QFrame(parent),
      line_(new ActTimeline(this)),
      before_(new QToolButton(this)),
      after_(new QToolButton(this)),
      time_(new DecimalSpinBox(this)),
      what_(new ShortLabel(this)),
      last_(new ShortLabel(this)),
      same_(new QLabel(this)),
      goOn_(new QPushButton(themeIcon("media-playback-start"), tr("&Go on from here"), this)) {
  setObjectName("replayBar");
  setFrameShape(QFrame::StyledPanel);
  line_->setObjectName("replayTimeline");
  line_->setAccessibleName(tr("Time of the replay"));
  line_->setToolTip(
      tr("Where the replay is; the strokes are what was done. Left and right: a second, with Shift to the "
         "act before and after; Home, End"));
  before_->setObjectName("replayActBefore");
  before_->setIcon(themeIcon("go-previous"));
  before_->setToolTip(tr("To the act before (Shift+Left)"));
  before_->setAccessibleName(tr("Act before"));
  after_->setObjectName("replayActAfter");
  after_->setIcon(themeIcon("go-next"));
  after_->setToolTip(tr("To the next act (Shift+Right)"));
  after_->setAccessibleName(tr("Next act"));
  for (QToolButton* button : {before_, after_}) button->setFocusPolicy(Qt::TabFocus);
  time_->setObjectName("replayTime");
  time_->setAccessibleName(tr("Go to this time"));
  time_->setToolTip(tr("Goes to this time of the session"));
  time_->setSuffix(tr(" s"));
  time_->setDecimals(3);
  time_->setKeyboardTracking(false);
  what_->setTextFormat(Qt::PlainText);
  last_->setTextFormat(Qt::PlainText);
  last_->setObjectName("replayLastAct");
  same_->setObjectName("replaySameness");
  goOn_->setObjectName("replayGoOn");
  goOn_->setToolTip(tr("Ends the replay: hands are on again, what came later in the log is left out"));
  auto* upper = new QHBoxLayout;
  upper->addWidget(before_);
  upper->addWidget(line_, 1);
  upper->addWidget(after_);
  upper->addWidget(time_);
  upper->addWidget(goOn_);
  auto* lower = new QHBoxLayout;
  lower->setSpacing(14);
  lower->addWidget(what_);
  lower->addWidget(same_);
  lower->addWidget(last_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 4, 6, 4);
  layout->setSpacing(2);
  layout->addLayout(upper);
  layout->addLayout(lower);
  connect(before_, &QToolButton::clicked, this, [this] { chooseAct(false); });
  connect(after_, &QToolButton::clicked, this, [this] { chooseAct(true); });
  connect(goOn_, &QPushButton::clicked, this, &ReplayBar::goOnWanted);
  connect(line_, &QSlider::valueChanged, this, [this](int period) { jump(period); });
  connect(time_, &QDoubleSpinBox::valueChanged, this, [this](double time_s) { jump(std::lround(time_s / period_s_)); });
}

void ReplayBar::begin(const QString& file) {
  log_ = {};
  at_ = 0;
  const QString name = QFileInfo(file).fileName();
  what_->setTexts(tr("Replay of %1; hands are off.").arg(name), tr("Replay"), file);
  same_->clear();
  last_->setTexts({});
  setEnabled(false);
}

void ReplayBar::showLog(const LiveLog& log, double period_s) {
  log_ = log;
  period_s_ = period_s;
  {
    const QSignalBlocker quietLine(line_), quietTime(time_);
    line_->setRange(static_cast<int>(log.from), static_cast<int>(std::max(log.from, log.until)));
    line_->setSingleStep(static_cast<int>(std::max(1L, std::lround(1 / period_s))));
    line_->setPageStep(static_cast<int>(std::max(1L, std::lround(5 / period_s))));
    time_->setRange(static_cast<double>(log.from) * period_s, static_cast<double>(log.until) * period_s);
    time_->setSingleStep(0.1);
  }
  line_->setActs(log.acts, period_s);
  setEnabled(true);
}

QString ReplayBar::sameness(const LiveRow& row) const {
  const LiveReplay& replay = *row.replay;
  if (replay.differsBy)
    return tr("✗ Not the same bits: the first difference is between the steps %1 and %2.")
        .arg(replay.sameUntil)
        .arg(*replay.differsBy);
  if (log_.marks == 0) return tr("This log has no marks to compare with.");
  if (replay.sameUntil >= log_.until) return tr("✓ Identical to the end, step %1.").arg(log_.until);
  if (replay.sameUntil > log_.from) return tr("✓ Identical up to step %1.").arg(replay.sameUntil);
  return tr("Not compared yet.");
}

void ReplayBar::showRow(const LiveRow& row) {
  if (!row.replay) return;
  at_ = row.period;
  line_->showPeriod(at_);
  if (!time_->hasFocus()) {
    const QSignalBlocker quiet(time_);
    time_->setValue(static_cast<double>(at_) * period_s_);
  }
  same_->setText(sameness(row));
  const Tones tones = tonesOf(this->palette());
  QPalette palette = same_->palette();
  palette.setColor(QPalette::WindowText, row.replay->differsBy ? tones.bad
                                         : row.replay->sameUntil > log_.from && log_.marks > 0
                                             ? tones.good
                                             : this->palette().color(QPalette::WindowText));
  same_->setPalette(palette);
  const LoggedActs* last = nullptr;
  bool later = false;
  for (const LoggedActs& act : log_.acts) {
    if (act.from < at_) last = &act;
    later |= act.from > at_;
  }
  before_->setEnabled(last != nullptr);
  after_->setEnabled(later);
  if (last) {
    const QString when = QString::number(static_cast<double>(last->from) * period_s_, 'f', 2);
    last_->setTexts(tr("Last act: %1, at %2 s").arg(last->name, when), last->name);
  } else {
    last_->setTexts(log_.acts.empty() ? tr("Nothing was done in it.") : tr("Nothing was done yet."), {});
  }
}

void ReplayBar::jump(long period) { emit jumpWanted(std::clamp(period, log_.from, std::max(log_.from, log_.until))); }

void ReplayBar::chooseAct(bool next) {
  const LoggedActs* wanted = nullptr;
  for (const LoggedActs& act : log_.acts) {
    if (next && act.from > at_) {
      wanted = &act;
      break;
    }
    if (!next && act.from < at_) wanted = &act;
  }
  if (wanted) jump(wanted->from);
}

void ReplayBar::chooseTime(double by_s) { jump(at_ + std::lround(by_s / period_s_)); }
void ReplayBar::chooseEnd(bool last) { jump(last ? log_.until : log_.from); }

}  // namespace btr::ui
