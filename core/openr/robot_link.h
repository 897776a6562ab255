#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace btr::openr {

/// What goes between a simulated robot and the process in which its OPEN-R objects run: one SensorFrame each 8 ms of
/// simulated time, answered by one OrderFrame. The process does nothing in between, so that the same frames give the
/// same orders. Units are OPEN-R's own: µrad, µm, µm/s², 10⁻⁶ of the SI unit. Places in `joints`, `sensors` and `lamps`
/// are those of the robot's design (robot_design.h).

struct JointReading {
  std::int32_t value_urad = 0;
  std::int32_t reference_urad = 0;  ///< what its servo follows now
  std::int16_t duty = 0;            ///< of the PWM, ±1023
};

struct PowerReading {
  std::uint16_t remaining_percent = 100;
  std::uint16_t temperature_dk = 2982;  ///< 0.1 K
  std::uint16_t voltage_mv = 7900;
  std::int16_t current_ma = -800;
  std::uint8_t volume = 3;  ///< 0 … 3
  bool pausePressed = false;
};

/// As the camera gives it at its highest resolution: for each row width bytes of Y, then of Cr, then of Cb.
struct CameraImage {
  std::uint16_t width = 0, height = 0;
  std::vector<std::uint8_t> rows;  ///< 3·width·height bytes
};

struct SensorFrame {
  std::uint32_t number = 1;  ///< of the frame, 1 … 0x0ffffff0, then 1 again
  std::int64_t time_us = 0;  ///< simulated, since the robot was switched on
  std::vector<JointReading> joints;
  std::vector<std::int32_t> sensors;  ///< value; its signal follows from the design
  PowerReading power;
  std::optional<CameraImage> image;  ///< in frames in which the camera has finished one
  std::string typed;                 ///< on the console since the last frame
  bool shutdown = false;             ///< the last frame: Stop and Destroy in all objects, then the process ends
};

/// Gains as OPEN-R counts them: 16-bit numbers and shifts.
struct JointGain {
  std::uint16_t p = 0, i = 0, d = 0, pShift = 0, iShift = 0, dShift = 0;
};

struct JointOrder {
  std::optional<std::int32_t> target_urad{};  ///< from this frame on; else as before
  std::optional<JointGain> gain{};            ///< from this frame on; else as before
  std::optional<bool> gainEnabled{};          ///< false: limp
};

struct LampOrder {
  std::uint16_t lamp = 0;       ///< place in the design's lamps
  std::uint8_t intensity = 0;   ///< 0 … 255; lamps that know only on and off: 0 or 255
  std::uint16_t mode = 0xffff;  ///< A 0, B 1, none 0xffff
};

struct CameraOrder {
  std::optional<std::uint32_t> whiteBalance, shutter, gain;  ///< OPEN-R's constants
};

struct ConsoleLine {
  std::string object, text;  ///< without the newline
};

/// Why a robot's program is no longer there.
struct Ended {
  enum class Why : std::uint8_t { shutdown, crash, endlessLoop, refused };
  Why why = Why::shutdown;
  std::string object, method, what;  ///< e.g. "MovingHead7", "ReadyEffector", "it read at address 0"
};

struct OrderFrame {
  std::vector<JointOrder> joints;  ///< one for each of the design's, or none where nothing changes
  std::vector<LampOrder> lamps;    ///< those that change
  std::optional<bool> motorPower{};
  CameraOrder camera{};
  std::vector<ConsoleLine> lines;
  std::optional<Ended> ended{};
};

/// Bytes of a message, little-endian, without its length. `…From` throws InputError for what is no such message; it
/// reads nothing beyond `size` and takes no more memory than some ten times that.
std::vector<std::uint8_t> bytesOf(const SensorFrame& frame);
std::vector<std::uint8_t> bytesOf(const OrderFrame& frame);
SensorFrame sensorFrameFrom(const std::uint8_t* bytes, std::size_t size);
OrderFrame orderFrameFrom(const std::uint8_t* bytes, std::size_t size);

}  // namespace btr::openr
