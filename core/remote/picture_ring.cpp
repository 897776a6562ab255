#include "core/remote/picture_ring.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <random>

#include "core/remote/refusal.h"

namespace btr::remote {
namespace {

struct Head {
  char magic[8];
  std::uint32_t layout, slots, firstSlot, slotBytes;
  std::uint64_t mark;
  std::int64_t newest;   ///< number of the last whole frame, 0 before the first
  std::uint32_t closed;  ///< 1: no more come
};
struct SlotHead {
  std::uint64_t sequence;  ///< odd while it is written, another even number after
  std::int64_t number, period;
  std::uint32_t width, height, rgbBytes, classBytes;
};
constexpr std::size_t headBytes = 64;  // of both, so that pixels begin at a line of the cache
static_assert(sizeof(Head) <= headBytes && sizeof(SlotHead) <= headBytes);
static_assert(std::atomic_ref<std::uint64_t>::is_always_lock_free);

std::size_t pixelsOf(const CameraPicture& picture) { return picture.rgb.size() + picture.classes.size(); }

[[noreturn]] void refuse(const char* what) {
  throw Refusal(Code::notNow, std::string("no memory to share pictures (") + what + ": " + std::strerror(errno) + ")");
}

}  // namespace

PictureRing::PictureRing(const CameraPicture& like) {
  room_ = (pixelsOf(like) + headBytes - 1) / headBytes * headBytes;
  slotBytes_ = headBytes + room_;
  bytes_ = headBytes + slots * slotBytes_;
  if (bytes_ > mostBytes)
    throw Refusal(Code::notNow, "pictures of " + std::to_string(pixelsOf(like)) + " bytes are too large to share");
  descriptor_ = memfd_create("uchilsim-pictures", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0) refuse("memfd_create");
  void* memory = MAP_FAILED;
  if (ftruncate(descriptor_, static_cast<off_t>(bytes_)) == 0)
    memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (memory == MAP_FAILED) {
    const int error = errno;
    close(descriptor_);
    errno = error;
    refuse("mmap");
  }
  memory_ = static_cast<unsigned char*>(memory);
  constexpr int sealNewWriters = 0x0010;  // F_SEAL_FUTURE_WRITE, Linux 5.1
  constexpr int sealSize = F_SEAL_SHRINK | F_SEAL_GROW;
  if (fcntl(descriptor_, F_ADD_SEALS, sealSize | sealNewWriters | F_SEAL_SEAL) != 0)
    fcntl(descriptor_, F_ADD_SEALS, sealSize | F_SEAL_SEAL);
  std::random_device random;
  mark_ = (std::uint64_t{random()} << 32) | random();
  Head head{{'U', 'C', 'H', 'I', 'R', 'I', 'N', 'G'},
            1,
            static_cast<std::uint32_t>(slots),
            static_cast<std::uint32_t>(headBytes),
            static_cast<std::uint32_t>(slotBytes_),
            mark_,
            0,
            0};
  std::memcpy(memory_, &head, sizeof head);
}

PictureRing::~PictureRing() {
  auto* head = reinterpret_cast<Head*>(memory_);
  std::atomic_ref(head->closed).store(1, std::memory_order_release);
  munmap(memory_, bytes_);
  close(descriptor_);
}

bool PictureRing::fits(const CameraPicture& picture) const { return pixelsOf(picture) <= room_; }

unsigned char* PictureRing::slot(std::int64_t number) const {
  return memory_ + headBytes + static_cast<std::size_t>(number) % slots * slotBytes_;
}

void PictureRing::write(std::int64_t number, std::int64_t period, const CameraPicture& picture) {
  unsigned char* at = slot(number);
  auto* head = reinterpret_cast<SlotHead*>(at);
  std::atomic_ref sequence(head->sequence);
  const std::uint64_t before = sequence.load(std::memory_order_relaxed);
  sequence.store(before + 1, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  head->number = number;
  head->period = period;
  head->width = static_cast<std::uint32_t>(picture.width);
  head->height = static_cast<std::uint32_t>(picture.height);
  head->rgbBytes = static_cast<std::uint32_t>(picture.rgb.size());
  head->classBytes = static_cast<std::uint32_t>(picture.classes.size());
  if (!picture.rgb.empty()) std::memcpy(at + headBytes, picture.rgb.data(), picture.rgb.size());
  if (!picture.classes.empty())
    std::memcpy(at + headBytes + picture.rgb.size(), picture.classes.data(), picture.classes.size());
  sequence.store(before + 2, std::memory_order_release);
  auto* all = reinterpret_cast<Head*>(memory_);
  std::atomic_ref(all->newest).store(number, std::memory_order_release);
}

std::string PictureRing::file() const {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
}

}  // namespace btr::remote
