#pragma once
#include <OPENR/OPrimitiveControl.h>

#include <cstdint>
#include <string>

#include "core/openr/runtime/robot/vector_player.h"

namespace btr::openr {

/// The loudspeaker: what is played stands in a WAV file, 16 kHz, 16 bits, one channel, from the first sound on with the
/// pauses between.
class SoundOut : public VectorPlayer {
 public:
  SoundOut(const ObserverID& id, std::string file, Complain complain)
      : VectorPlayer(id, std::move(complain)), file_(std::move(file)) {}
  ~SoundOut() override;

  void setTime(std::int64_t time_us) { time_us_ = time_us; }
  void setMuted(bool muted) { muted_ = muted; }
  /// [dB/256] as ospkvol… have it.
  void setVolume(longword volume) { volume_ = volume; }
  OStatus setType(OSpeakerSoundType type);
  OSpeakerSoundType type() const { return type_; }
  /// Ends the file. Its path, if there is one.
  std::string close();

 private:
  bool read(Vector& vector) override;
  void play(const Vector& vector) override;
  void append(const std::int16_t* samples, std::size_t count);
  void header();

  std::string file_;
  void* out_ = nullptr;
  std::uint64_t written_ = 0, headed_ = 0;  ///< samples
  std::int64_t time_us_ = 0, begin_us_ = 0;
  bool muted_ = false, failed_ = false;
  longword volume_ = ospkvol10dB;
  OSpeakerSoundType type_ = ospksndMONO8K8B;
};

}  // namespace btr::openr
