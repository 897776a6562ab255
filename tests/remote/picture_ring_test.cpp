// Frames in memory that other processes read: whole ones only, of bounded size, and nothing stays behind.
#include "core/remote/picture_ring.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <optional>

#include "core/remote/refusal.h"

namespace {

using namespace btr;
using namespace btr::remote;
namespace fs = std::filesystem;

constexpr int width = 64, height = 48;
constexpr std::size_t pixels = std::size_t{3} * width * height;

CameraPicture shade(std::int64_t number) {
  return {width, height, std::vector<std::uint8_t>(pixels, static_cast<std::uint8_t>(number))};
}

/// Reads as uchilsim.proto says, knowing nothing of the writer's code.
class Reader {
 public:
  explicit Reader(const PictureRing& ring) : bytes_(ring.bytes()) {
    const int file = open(ring.file().c_str(), O_RDONLY | O_CLOEXEC);
    memory_ = static_cast<const char*>(mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, file, 0));
    close(file);
  }
  ~Reader() { munmap(const_cast<char*>(memory_), bytes_); }

  template <class T>
  T at(std::size_t byte) const {
    T value;
    std::memcpy(&value, memory_ + byte, sizeof value);
    return value;
  }
  std::string magic() const { return std::string(memory_, 8); }
  std::int64_t newest() const { return at<std::int64_t>(32); }
  bool closed() const { return at<std::uint32_t>(40) == 1; }
  std::uint64_t mark() const { return at<std::uint64_t>(24); }
  std::uint32_t slots() const { return at<std::uint32_t>(12); }

  /// The pixels of a frame; nothing if it is not there or was written meanwhile.
  std::optional<std::string> frame(std::int64_t number) const {
    const std::size_t begin =
        at<std::uint32_t>(16) + static_cast<std::size_t>(number) % slots() * at<std::uint32_t>(20);
    const auto before = at<std::uint64_t>(begin);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (before % 2 == 1 || at<std::int64_t>(begin + 8) != number) return std::nullopt;
    // Byte by byte: slower than the writer, which laps it.
    std::string rgb(at<std::uint32_t>(begin + 32), '\0');
    const volatile char* from = memory_ + begin + 64;
    for (char& pixel : rgb) pixel = *from++;
    std::atomic_thread_fence(std::memory_order_acquire);
    if (at<std::uint64_t>(begin) != before) return std::nullopt;
    return rgb;
  }

 private:
  std::size_t bytes_;
  const char* memory_;
};

TEST(PictureRing, KeepsTheLastFrames) {
  PictureRing ring(shade(0));
  const Reader reader(ring);
  EXPECT_EQ(std::string("UCHIRING"), reader.magic());
  EXPECT_EQ(ring.mark(), reader.mark());
  EXPECT_EQ(0, reader.newest());
  for (std::int64_t number = 1; number <= 10; ++number) ring.write(number, 4 * number, shade(number));
  EXPECT_EQ(10, reader.newest());
  for (std::int64_t number = 7; number <= 10; ++number)
    EXPECT_EQ(std::string(pixels, static_cast<char>(number)), reader.frame(number));
  EXPECT_FALSE(reader.frame(6));
  EXPECT_FALSE(reader.frame(11));
}

/// What two processes tell each other.
struct Shared {
  std::atomic<int> tries{0};
  std::atomic_bool ends{false};
};

TEST(PictureRing, AnotherProcessNeverSeesATornFrame) {
  constexpr int triesWhileWritten = 5000, wholeAtLeast = 100;
  PictureRing ring(shade(0));
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* shared = new (memory) Shared;
  const pid_t reading = fork();
  if (reading == 0) {
    const Reader reader(ring);
    int whole = 0;
    bool torn = false;
    while (!torn && (whole < wholeAtLeast || !shared->ends)) {
      const auto number = reader.newest();
      if (number == 0) continue;  // not yet
      const auto frame = reader.frame(number);
      ++shared->tries;
      if (!frame) continue;
      ++whole;
      torn = *frame != std::string(pixels, static_cast<char>(number));
    }
    shared->tries = triesWhileWritten;
    _exit(torn ? 1 : 0);
  }
  for (std::int64_t number = 1; shared->tries < triesWhileWritten; ++number) ring.write(number, number, shade(number));
  shared->ends = true;
  int status = -1;
  ASSERT_EQ(reading, waitpid(reading, &status, 0));
  EXPECT_EQ(0, status);
  munmap(memory, sizeof(Shared));
}

TEST(PictureRing, IsWrittenByItsMakerAlone) {
  PictureRing ring(shade(0));
  const int file = open(ring.file().c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;  // not even opened
  EXPECT_NE(0, ftruncate(file, 10));
  EXPECT_NE(0, ftruncate(file, 1 << 24));
  EXPECT_EQ(-1, pwrite(file, "x", 1, 0));
  EXPECT_EQ(MAP_FAILED, mmap(nullptr, ring.bytes(), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  close(file);
}

TEST(PictureRing, SaysThatItEndsAndLeavesNothing) {
  const auto descriptors = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = descriptors();
  auto ring = std::make_unique<PictureRing>(shade(0));
  ring->write(1, 1, shade(1));
  const Reader reader(*ring);
  EXPECT_FALSE(reader.closed());
  ring.reset();
  EXPECT_TRUE(reader.closed());
  EXPECT_EQ(std::string(pixels, 1), reader.frame(1));  // whoever has it keeps it
  EXPECT_EQ(before, descriptors());
}

TEST(PictureRing, HasRoomForFramesOfItsSizeOnly) {
  PictureRing ring(shade(0));
  EXPECT_TRUE(ring.fits(shade(1)));
  CameraPicture larger = shade(1);
  larger.rgb.resize(2 * pixels);
  EXPECT_FALSE(ring.fits(larger));
  larger.rgb.resize(PictureRing::mostBytes);
  EXPECT_THROW(PictureRing{larger}, Refusal);
}

}  // namespace
