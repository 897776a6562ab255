#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/sim/controller.h"

namespace btr::remote {

/// The last frames of a camera in memory that other processes of the same user on this machine read, as
/// uchilsim.proto says (PictureMemoryReply). It has no name: it is gone with the last process that holds it, however
/// that ends. Who reads it can neither write it nor change its size.
class PictureRing {
 public:
  static constexpr std::size_t slots = 4;
  static constexpr std::size_t mostBytes = 32u << 20;  ///< of all slots

  /// For frames as large as this one. Throws Refusal where the system has no such memory, or the frame is too large.
  explicit PictureRing(const CameraPicture& like);
  /// Says to its readers that no more come.
  ~PictureRing();
  PictureRing(const PictureRing&) = delete;
  PictureRing& operator=(const PictureRing&) = delete;

  bool fits(const CameraPicture& picture) const;
  /// In place of the oldest one. `number` goes up from one to the next; the picture must fit.
  void write(std::int64_t number, std::int64_t period, const CameraPicture& picture);

  /// What a reader opens, only to read.
  std::string file() const;
  std::size_t bytes() const { return bytes_; }
  /// A number that stands in the memory too: who reads it there has opened the right one.
  std::uint64_t mark() const { return mark_; }

 private:
  unsigned char* slot(std::int64_t number) const;

  int descriptor_ = -1;
  unsigned char* memory_ = nullptr;
  std::size_t room_ = 0, slotBytes_ = 0, bytes_ = 0;
  std::uint64_t mark_ = 0;
};

}  // namespace btr::remote
