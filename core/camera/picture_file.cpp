#include "core/camera/picture_file.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/json_reader.h"
#include "core/spec/parameter.h"
#include "core/spec/require.h"

namespace btr {
namespace {

constexpr int mostPictureSide_px = 8192;

std::vector<std::uint8_t> encodedPicture(const RgbPicture& picture, const char* ending,
                                         const std::vector<int>& settings) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  require(pixels > 0 && picture.rgb.size() == 3 * pixels, "a picture has three bytes a pixel");
  // OpenCV wants blue first, and does not write to what it encodes.
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  require(cv::imencode(ending, bgr, bytes, settings), "OpenCV writes PNG and JPEG");
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> pngBytes(const RgbPicture& picture) { return encodedPicture(picture, ".png", {}); }

std::vector<std::uint8_t> jpegBytes(const RgbPicture& picture, int quality) {
  check(Parameter{"quality", "", "", 1, 100, 75, {}, true}, quality, "JPEG quality");
  return encodedPicture(picture, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

RgbPicture decodedPicture(std::span<const std::uint8_t> bytes, const std::string& place) {
  const auto refuse = [&](const std::string& why) -> InputError {
    return InputError(place + ": " + why + "; a PNG or JPEG picture of at most " + std::to_string(mostPictureSide_px) +
                      " pixels on a side is expected");
  };
  if (bytes.empty()) throw refuse("is empty");
  cv::Mat bgr;
  try {
    bgr = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<std::uint8_t*>(bytes.data())),
                       cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw refuse("cannot be decoded (" + error.err + ")");
  }
  if (bgr.empty()) throw refuse("is no picture");
  if (bgr.cols > mostPictureSide_px || bgr.rows > mostPictureSide_px)
    throw refuse("has " + std::to_string(bgr.cols) + "x" + std::to_string(bgr.rows) + " pixels");
  RgbPicture picture{bgr.cols, bgr.rows, {}};
  picture.rgb.resize(3 * static_cast<std::size_t>(bgr.cols) * static_cast<std::size_t>(bgr.rows));
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, picture.rgb.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return picture;
}

RgbPicture readPicture(const std::string& path) {
  const std::string content = readFile(path, std::size_t{256} << 20);
  return decodedPicture({reinterpret_cast<const std::uint8_t*>(content.data()), content.size()}, path);
}

void writePicture(const std::string& path, const RgbPicture& picture, int jpegQuality) {
  const std::string ending = fileEnding(path);
  const bool jpeg = ending == ".jpg" || ending == ".jpeg";
  if (!jpeg && ending != ".png") throw InputError(path, "the ending \"" + ending + "\"", ".png, .jpg or .jpeg");
  const std::vector<std::uint8_t> bytes = jpeg ? jpegBytes(picture, jpegQuality) : pngBytes(picture);
  writeFile(path, {bytes.begin(), bytes.end()});
}

RgbPicture classPicture(int width, int height, std::span<const std::uint8_t> classes) {
  // Of Okabe and Ito (2008), told apart by nearly everybody; black is nothing.
  constexpr std::uint8_t colours[9][3] = {{0, 0, 0},     {230, 159, 0}, {86, 180, 233},  {0, 158, 115},  {240, 228, 66},
                                          {0, 114, 178}, {213, 94, 0},  {204, 121, 167}, {255, 255, 255}};
  RgbPicture picture{width, height, {}};
  picture.rgb.reserve(3 * classes.size());
  for (const std::uint8_t one : classes) {
    const std::uint8_t* colour = colours[one < 9 ? one : 0];
    picture.rgb.insert(picture.rgb.end(), colour, colour + 3);
  }
  return picture;
}

}  // namespace btr
