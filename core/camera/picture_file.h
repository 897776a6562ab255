#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace btr {

/// 8 bits a channel, red, green, blue; rows from the upper left.
struct RgbPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 a pixel
};

/// A PNG, JPEG or other picture that OpenCV reads, at most 8192 pixels on a side; grey becomes RGB, more than 8 bits
/// become 8. Throws InputError.
RgbPicture readPicture(const std::string& path);

/// As a file in memory. Throws InputError if `quality` is not 1 to 100.
std::vector<std::uint8_t> pngBytes(const RgbPicture& picture);
std::vector<std::uint8_t> jpegBytes(const RgbPicture& picture, int quality);
/// Throws InputError if the bytes are no picture; `place` begins the message.
RgbPicture decodedPicture(std::span<const std::uint8_t> bytes, const std::string& place);

/// Replaces the file at once. The ending decides: .png, .jpg, .jpeg. Throws InputError.
void writePicture(const std::string& path, const RgbPicture& picture, int jpegQuality = 95);

/// Colours of the classes of a frame, for people: black for none, else eight that are easily told apart.
RgbPicture classPicture(int width, int height, std::span<const std::uint8_t> classes);

}  // namespace btr
