#include "ui/scene3d/playback.h"

#include <algorithm>
#include <cmath>

namespace btr::ui {

void Playback::setTimes(std::vector<double> times_s) {
  times_ = std::move(times_s);
  playing_ = false;
  moveTo(start());
}

void Playback::setPlaying(bool playing) {
  playing_ = playing && times_.size() > 1;
  if (playing_ && position_ >= end()) moveTo(start());
}

void Playback::advance(double elapsed_s) {
  if (!playing_) return;
  const double target = position_ + speed_ * elapsed_s, length = end() - start();
  if (target < end()) return moveTo(target);
  if (looping_) return moveTo(start() + std::fmod(target - start(), length));
  playing_ = false;
  moveTo(end());
}

void Playback::showFrame(std::size_t frame) {
  playing_ = false;
  if (!times_.empty()) moveTo(times_[std::min(frame, times_.size() - 1)]);
}

void Playback::showTime(double time_s) {
  playing_ = false;
  moveTo(std::clamp(time_s, start(), end()));
}

void Playback::step(int frames) {
  const auto target = static_cast<long long>(frame_) + frames;
  showFrame(static_cast<std::size_t>(std::max(0LL, target)));
}

void Playback::moveTo(double position_s) {
  position_ = position_s;
  const auto after = std::upper_bound(times_.begin(), times_.end(), position_s);
  frame_ = after == times_.begin() ? 0 : static_cast<std::size_t>(after - times_.begin()) - 1;
}

}  // namespace btr::ui
