#pragma once
#include <memory>
#include <string>

#include "core/camera/picture_file.h"

namespace btr {

/// Writes a video with FFmpeg: H.264 where it has that, else MPEG-4. The ending decides about the container: .mp4,
/// .avi, .mkv. Until finish() there is only a file beside it, which goes away with the writer.
class VideoWriter {
 public:
  /// Throws InputError if the ending is another one, the folder cannot be written or there is no codec.
  VideoWriter(const std::string& path, int width, int height, double frameRate_hz);
  ~VideoWriter();
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;

  void add(const RgbPicture& picture);  ///< of the size that was said
  long frames() const;
  const std::string& codec() const;  ///< "H.264" or "MPEG-4"
  /// Closes the file, reads it back, and puts it in its place. Throws InputError if it does not have all frames (the
  /// disk is full).
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Frames of a video that can be decoded, and how large they are. Throws InputError.
struct VideoFacts {
  int width = 0, height = 0;
  double frameRate_hz = 0;
  long frames = 0;
};
VideoFacts readVideoFacts(const std::string& path);

}  // namespace btr
