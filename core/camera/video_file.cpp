#include "core/camera/video_file.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/require.h"
#include "core/spec/system/output_path.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

struct VideoCodec {
  const char* name;
  int fourcc;
};

const VideoCodec videoCodecs[] = {{"H.264", cv::VideoWriter::fourcc('a', 'v', 'c', '1')},
                                  {"MPEG-4", cv::VideoWriter::fourcc('m', 'p', '4', 'v')}};

// Beside the file itself, with its ending: FFmpeg chooses the container by that.
std::string unfinishedName(const fs::path& path) {
  const std::string name = "." + path.stem().string() + "." + std::to_string(::getpid()) + ".part";
  return (path.parent_path() / (name + path.extension().string())).string();
}

// What is wrong is said once, by us: FFmpeg's own lines on standard error are switched off, unless somebody wants them.
void silenceFfmpeg() { ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0); }

}  // namespace

struct VideoWriter::Parts {
  std::string path, unfinished, codec;
  int width = 0, height = 0;
  long frames = 0;
  cv::VideoWriter writer;
  cv::Mat bgr;

  ~Parts() {
    writer.release();
    std::error_code ignored;
    if (!unfinished.empty()) fs::remove(unfinished, ignored);
  }
};

VideoWriter::VideoWriter(const std::string& path, int width, int height, double frameRate_hz)
    : parts_(std::make_unique<Parts>()) {
  const std::string ending = fileEnding(path);
  if (ending != ".mp4" && ending != ".avi" && ending != ".mkv")
    throw InputError(path, "the ending \"" + ending + "\"", ".mp4, .avi or .mkv");
  if (width % 2 != 0 || height % 2 != 0)
    throw InputError(path, std::to_string(width) + "x" + std::to_string(height) + " pixels",
                     "an even number of columns and rows, as H.264 wants it");
  checkOutputFile(path, {});
  silenceFfmpeg();
  parts_->path = path;
  parts_->width = width;
  parts_->height = height;
  parts_->unfinished = unfinishedName(path);
  for (const VideoCodec& codec : videoCodecs) {
    if (!parts_->writer.open(parts_->unfinished, cv::CAP_FFMPEG, codec.fourcc, frameRate_hz, {width, height})) continue;
    parts_->codec = codec.name;
    return;
  }
  throw InputError(path + ": no video can be written: OpenCV's FFmpeg has neither H.264 nor MPEG-4 here");
}

VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::add(const RgbPicture& picture) {
  require(picture.width == parts_->width && picture.height == parts_->height, "all frames of a video have one size");
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::cvtColor(rgb, parts_->bgr, cv::COLOR_RGB2BGR);
  parts_->writer.write(parts_->bgr);
  ++parts_->frames;
}

long VideoWriter::frames() const { return parts_->frames; }
const std::string& VideoWriter::codec() const { return parts_->codec; }

void VideoWriter::finish() {
  Parts& p = *parts_;
  if (p.frames == 0) throw InputError(p.path + ": a video without a frame cannot be written");
  p.writer.release();
  // FFmpeg keeps silent about a disk that is full: what can be read back is what there is.
  long whole = 0;
  try {
    whole = readVideoFacts(p.unfinished).frames;
  } catch (const InputError&) {
    whole = 0;
  }
  if (whole != p.frames) {
    std::error_code error;
    const fs::space_info space = fs::space(fs::absolute(p.unfinished).parent_path(), error);
    throw InputError(p.path + ": only " + std::to_string(whole) + " of " + std::to_string(p.frames) +
                     " frames could be written" +
                     (error ? "" : " (" + std::to_string(space.available / 1024) + " KiB are free on the disk)"));
  }
  std::error_code error;
  fs::rename(p.unfinished, p.path, error);
  if (error) throw InputError(p.path + ": cannot be replaced (" + error.message() + ")");
  p.unfinished.clear();
}

VideoFacts readVideoFacts(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) throw InputError(path + ": is no file");
  silenceFfmpeg();
  cv::VideoCapture video(path, cv::CAP_FFMPEG);
  if (!video.isOpened()) throw InputError(path + ": is no video that FFmpeg reads");
  VideoFacts facts;
  facts.width = static_cast<int>(video.get(cv::CAP_PROP_FRAME_WIDTH));
  facts.height = static_cast<int>(video.get(cv::CAP_PROP_FRAME_HEIGHT));
  facts.frameRate_hz = video.get(cv::CAP_PROP_FPS);
  while (video.grab()) ++facts.frames;
  return facts;
}

}  // namespace btr
