#include "core/openr/robot_link.h"

#include <cstring>
#include <limits>
#include <type_traits>

#include "core/spec/error.h"

namespace btr::openr {
namespace {

constexpr std::uint32_t sensorMagic = 0x31735262, orderMagic = 0x316f5262;  // kind and version of the message

class Writer {
 public:
  std::vector<std::uint8_t> bytes;

  template <class T>
  void number(T value) {
    static_assert(std::is_integral_v<T>);
    auto rest = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes.push_back(static_cast<std::uint8_t>(rest & 0xff));
      if constexpr (sizeof(T) > 1) rest = static_cast<std::make_unsigned_t<T>>(rest >> 8);
    }
  }
  void flag(bool value) { number<std::uint8_t>(value ? 1 : 0); }
  void text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
  template <class T>
  void maybe(const std::optional<T>& value) {
    flag(value.has_value());
    if constexpr (std::is_same_v<T, bool>) {
      if (value) flag(*value);
    } else {
      if (value) number(*value);
    }
  }
};

class Reader {
 public:
  Reader(const std::uint8_t* bytes, std::size_t size, const char* what) : at_(bytes), left_(size), what_(what) {}

  template <class T>
  T number() {
    need(sizeof(T));
    std::make_unsigned_t<T> value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      value = static_cast<std::make_unsigned_t<T>>(
          value | static_cast<std::make_unsigned_t<T>>(static_cast<std::make_unsigned_t<T>>(at_[i]) << (8 * i)));
    at_ += sizeof(T);
    left_ -= sizeof(T);
    return static_cast<T>(value);
  }
  bool flag() {
    const auto value = number<std::uint8_t>();
    if (value > 1) refuse("a yes or no that is " + std::to_string(value));
    return value == 1;
  }
  /// A count of things of which each takes at least `bytesEach` bytes.
  std::size_t count(std::size_t bytesEach) {
    const auto value = number<std::uint32_t>();
    if (value > left_ / bytesEach) refuse("a count of " + std::to_string(value) + " with too few bytes behind it");
    return value;
  }
  std::string text() {
    const std::size_t size = count(1);
    std::string value(reinterpret_cast<const char*>(at_), size);
    at_ += size;
    left_ -= size;
    return value;
  }
  std::vector<std::uint8_t> block(std::size_t size) {
    need(size);
    std::vector<std::uint8_t> value(at_, at_ + size);
    at_ += size;
    left_ -= size;
    return value;
  }
  template <class T>
  void maybe(std::optional<T>& value) {
    if (!flag()) return;
    if constexpr (std::is_same_v<T, bool>)
      value = flag();
    else
      value = number<T>();
  }
  void begin(std::uint32_t magic) {
    if (number<std::uint32_t>() != magic) refuse("another kind of message");
  }
  void end() {
    if (left_ > 0) refuse(std::to_string(left_) + " bytes more than the message has");
  }
  [[noreturn]] void refuse(const std::string& found) const { throw InputError(what_, found, "a whole message is"); }

 private:
  void need(std::size_t size) {
    if (left_ < size) refuse("a message that ends early");
  }
  const std::uint8_t* at_;
  std::size_t left_;
  const char* what_;
};

void write(Writer& out, const PowerReading& power) {
  out.number(power.remaining_percent);
  out.number(power.temperature_dk);
  out.number(power.voltage_mv);
  out.number(power.current_ma);
  out.number(power.volume);
  out.flag(power.pausePressed);
}

PowerReading powerFrom(Reader& in) {
  PowerReading power;
  power.remaining_percent = in.number<std::uint16_t>();
  power.temperature_dk = in.number<std::uint16_t>();
  power.voltage_mv = in.number<std::uint16_t>();
  power.current_ma = in.number<std::int16_t>();
  power.volume = in.number<std::uint8_t>();
  power.pausePressed = in.flag();
  return power;
}

CameraImage imageFrom(Reader& in) {
  CameraImage image;
  image.width = in.number<std::uint16_t>();
  image.height = in.number<std::uint16_t>();
  image.rows = in.block(std::size_t{3} * image.width * image.height);
  return image;
}

void write(Writer& out, const JointGain& gain) {
  for (const std::uint16_t value : {gain.p, gain.i, gain.d, gain.pShift, gain.iShift, gain.dShift}) out.number(value);
}

JointGain gainFrom(Reader& in) {
  JointGain gain;
  for (std::uint16_t* value : {&gain.p, &gain.i, &gain.d, &gain.pShift, &gain.iShift, &gain.dShift})
    *value = in.number<std::uint16_t>();
  return gain;
}

void write(Writer& out, const JointOrder& joint) {
  out.maybe(joint.target_urad);
  out.flag(joint.gain.has_value());
  if (joint.gain) write(out, *joint.gain);
  out.maybe(joint.gainEnabled);
}

JointOrder jointFrom(Reader& in) {
  JointOrder joint;
  in.maybe(joint.target_urad);
  if (in.flag()) joint.gain = gainFrom(in);
  in.maybe(joint.gainEnabled);
  return joint;
}

Ended endedFrom(Reader& in) {
  Ended ended;
  const auto why = in.number<std::uint8_t>();
  if (why > static_cast<std::uint8_t>(Ended::Why::refused)) in.refuse("a reason numbered " + std::to_string(why));
  ended.why = static_cast<Ended::Why>(why);
  ended.object = in.text();
  ended.method = in.text();
  ended.what = in.text();
  return ended;
}

}  // namespace

std::vector<std::uint8_t> bytesOf(const SensorFrame& frame) {
  Writer out;
  out.number(sensorMagic);
  out.number(frame.number);
  out.number(frame.time_us);
  out.number(static_cast<std::uint32_t>(frame.joints.size()));
  for (const JointReading& joint : frame.joints) {
    out.number(joint.value_urad);
    out.number(joint.reference_urad);
    out.number(joint.duty);
  }
  out.number(static_cast<std::uint32_t>(frame.sensors.size()));
  for (const std::int32_t value : frame.sensors) out.number(value);
  write(out, frame.power);
  out.flag(frame.image.has_value());
  if (frame.image) {
    if (frame.image->rows.size() != std::size_t{3} * frame.image->width * frame.image->height)
      throw InputError("camera image", std::to_string(frame.image->rows.size()) + " bytes", "3 for each pixel are");
    out.number(frame.image->width);
    out.number(frame.image->height);
    out.bytes.insert(out.bytes.end(), frame.image->rows.begin(), frame.image->rows.end());
  }
  out.text(frame.typed);
  out.flag(frame.shutdown);
  return std::move(out.bytes);
}

SensorFrame sensorFrameFrom(const std::uint8_t* bytes, std::size_t size) {
  Reader in(bytes, size, "sensor frame");
  in.begin(sensorMagic);
  SensorFrame frame;
  frame.number = in.number<std::uint32_t>();
  frame.time_us = in.number<std::int64_t>();
  frame.joints.resize(in.count(10));
  for (JointReading& joint : frame.joints) {
    joint.value_urad = in.number<std::int32_t>();
    joint.reference_urad = in.number<std::int32_t>();
    joint.duty = in.number<std::int16_t>();
  }
  frame.sensors.resize(in.count(4));
  for (std::int32_t& value : frame.sensors) value = in.number<std::int32_t>();
  frame.power = powerFrom(in);
  if (in.flag()) frame.image = imageFrom(in);
  frame.typed = in.text();
  frame.shutdown = in.flag();
  in.end();
  return frame;
}

std::vector<std::uint8_t> bytesOf(const OrderFrame& frame) {
  Writer out;
  out.number(orderMagic);
  out.number(static_cast<std::uint32_t>(frame.joints.size()));
  for (const JointOrder& joint : frame.joints) write(out, joint);
  out.number(static_cast<std::uint32_t>(frame.lamps.size()));
  for (const LampOrder& lamp : frame.lamps) {
    out.number(lamp.lamp);
    out.number(lamp.intensity);
    out.number(lamp.mode);
  }
  out.maybe(frame.motorPower);
  out.maybe(frame.camera.whiteBalance);
  out.maybe(frame.camera.shutter);
  out.maybe(frame.camera.gain);
  out.number(static_cast<std::uint32_t>(frame.lines.size()));
  for (const ConsoleLine& line : frame.lines) {
    out.text(line.object);
    out.text(line.text);
  }
  out.flag(frame.ended.has_value());
  if (frame.ended) {
    out.number(static_cast<std::uint8_t>(frame.ended->why));
    out.text(frame.ended->object);
    out.text(frame.ended->method);
    out.text(frame.ended->what);
  }
  return std::move(out.bytes);
}

OrderFrame orderFrameFrom(const std::uint8_t* bytes, std::size_t size) {
  Reader in(bytes, size, "order frame");
  in.begin(orderMagic);
  OrderFrame frame;
  for (std::size_t left = in.count(3); left > 0; --left) frame.joints.push_back(jointFrom(in));
  frame.lamps.resize(in.count(5));
  for (LampOrder& lamp : frame.lamps) {
    lamp.lamp = in.number<std::uint16_t>();
    lamp.intensity = in.number<std::uint8_t>();
    lamp.mode = in.number<std::uint16_t>();
  }
  in.maybe(frame.motorPower);
  in.maybe(frame.camera.whiteBalance);
  in.maybe(frame.camera.shutter);
  in.maybe(frame.camera.gain);
  for (std::size_t left = in.count(8); left > 0; --left) {
    ConsoleLine line;
    line.object = in.text();
    line.text = in.text();
    frame.lines.push_back(std::move(line));
  }
  if (in.flag()) frame.ended = endedFrom(in);
  in.end();
  return frame;
}

}  // namespace btr::openr
