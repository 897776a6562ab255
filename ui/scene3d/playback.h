#pragma once
#include <cstddef>
#include <vector>

namespace btr::ui {

/// Where a replay stands: recorded moments, a position between them, a speed. Arithmetic alone; whoever owns it tells
/// it how much time went by. The shown frame is the last one whose time is not after the position.
class Playback {
 public:
  /// Increasing times [s]; none: there is nothing to play.
  void setTimes(std::vector<double> times_s);

  std::size_t frames() const { return times_.size(); }
  std::size_t frame() const { return frame_; }
  double position() const { return position_; }  ///< s, in the recording's own time
  double start() const { return times_.empty() ? 0 : times_.front(); }
  double end() const { return times_.empty() ? 0 : times_.back(); }
  double timeOf(std::size_t frame) const { return times_.at(frame); }

  bool playing() const { return playing_; }
  /// At the end playing begins anew; without frames it stays off.
  void setPlaying(bool playing);
  bool looping() const { return looping_; }
  void setLooping(bool looping) { looping_ = looping; }
  double speed() const { return speed_; }
  /// Recorded seconds per second, > 0.
  void setSpeed(double speed) { speed_ = speed; }

  /// Time that passed for the viewer [s]. Stops at the end, or goes on from the start when looping.
  void advance(double elapsed_s);
  /// These stop the playing. A frame beyond the ends is the end.
  void showFrame(std::size_t frame);
  void showTime(double time_s);
  void step(int frames);

 private:
  void moveTo(double position_s);

  std::vector<double> times_;
  std::size_t frame_ = 0;
  double position_ = 0, speed_ = 1;
  bool playing_ = false, looping_ = false;
};

}  // namespace btr::ui
