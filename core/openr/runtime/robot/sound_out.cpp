#include "core/openr/runtime/robot/sound_out.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

namespace btr::openr {
namespace {

constexpr std::uint64_t rate_hz = 16000;
constexpr std::uint64_t longest = rate_hz * 3600;  // samples in a file: one hour
constexpr std::size_t frame_ms = 8;

struct Form {
  std::size_t rate_hz, bytes, channels;
};

Form formOf(OSpeakerSoundType type) {
  switch (type) {
    case ospksndMONO16K8B:
      return {16000, 1, 1};
    case ospksndMONO16K16B:
      return {16000, 2, 1};
    case ospksndSTEREO16K16B:
      return {16000, 2, 2};
    default:
      return {8000, 1, 1};
  }
}

std::FILE* file(void* out) { return static_cast<std::FILE*>(out); }

void put(std::FILE* out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) std::fputc(static_cast<int>((value >> (8 * i)) & 0xff), out);
}

}  // namespace

SoundOut::~SoundOut() { close(); }

OStatus SoundOut::setType(OSpeakerSoundType type) {
  if (type == ospksndMONO11K8B || type > ospksndSTEREO16K16B) return oNOT_SUPPORTED;
  type_ = type;
  return oSUCCESS;
}

bool SoundOut::read(Vector& vector) {
  auto* data = reinterpret_cast<OSoundVectorData*>(vector.region->Base());
  const std::size_t size = vector.region->Size();
  const bool large = size >= sizeof(ODataVectorInfo) + sizeof(OSoundInfo);
  const OSoundInfo info = large ? *data->GetInfo(0) : OSoundInfo{};
  if (!large || data->vectorInfo.numData < 1 || info.dataOffset > size || info.dataSize > size - info.dataOffset) {
    complain_(
        vector.from, "sound",
        "what was sent to the Speaker is no sound vector with data in its region: OPENR::NewSoundVectorData makes "
        "one, SetNumData(1) and the info's dataSize say what is in it");
    return false;
  }
  vector.wait = data->vectorInfo.wait;
  vector.key = data->vectorInfo.syncKey;
  const Form form = formOf(type_);
  const std::size_t perFrame = form.rate_hz * form.bytes * form.channels * frame_ms / 1000;
  vector.length = std::max<std::size_t>((info.dataSize + perFrame - 1) / perFrame, 1);
  const std::size_t step = form.bytes * form.channels, repeat = rate_hz / form.rate_hz;
  auto samples = std::make_shared<std::vector<std::int16_t>>();
  for (std::size_t at = 0; at + step <= info.dataSize; at += step) {
    const byte* from = data->GetData(0) + at;
    const auto value = form.bytes == 1 ? static_cast<std::int16_t>(static_cast<sbyte>(from[0]) * 256)
                                       : static_cast<std::int16_t>(from[0] | (from[1] << 8));
    samples->insert(samples->end(), repeat, value);
  }
  vector.content = samples;
  return true;
}

void SoundOut::play(const Vector& vector) {
  if (vector.frame != 0 || failed_) return;
  const auto& samples = *std::static_pointer_cast<std::vector<std::int16_t>>(vector.content);
  if (out_ == nullptr) {
    out_ = std::fopen(file_.c_str(), "wb");
    failed_ = out_ == nullptr;
    if (failed_) return;
    begin_us_ = time_us_;
    header();
  }
  const auto due = static_cast<std::uint64_t>((time_us_ - begin_us_) * static_cast<std::int64_t>(rate_hz) / 1000000);
  const std::vector<std::int16_t> silence(4096);
  while (written_ < due && written_ < longest)
    append(silence.data(), static_cast<std::size_t>(std::min<std::uint64_t>(due - written_, silence.size())));
  const bool silent = muted_ || volume_ == ospkvolinfdB;
  const double factor = silent ? 0 : std::pow(10, static_cast<sword>(volume_ & 0xffff) / 256.0 / 20);
  std::vector<std::int16_t> scaled(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    scaled[i] = static_cast<std::int16_t>(std::lround(std::clamp(samples[i] * factor, -32768.0, 32767.0)));
  if (written_ < longest) append(scaled.data(), scaled.size());
  if (written_ < headed_ + rate_hz) return;
  headed_ = written_;  // the file is whole, whatever happens to the process
  std::fseek(file(out_), 0, SEEK_SET);
  header();
  std::fseek(file(out_), 0, SEEK_END);
  std::fflush(file(out_));
}

void SoundOut::append(const std::int16_t* samples, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) put(file(out_), static_cast<std::uint16_t>(samples[i]), 2);
  written_ += count;
}

void SoundOut::header() {
  std::FILE* out = file(out_);
  const auto bytes = static_cast<std::uint32_t>(written_ * 2);
  std::fwrite("RIFF", 1, 4, out);
  put(out, 36 + bytes, 4);
  std::fwrite("WAVEfmt ", 1, 8, out);
  put(out, 16, 4);
  put(out, 1, 2);  // PCM
  put(out, 1, 2);  // channels
  put(out, rate_hz, 4);
  put(out, rate_hz * 2, 4);
  put(out, 2, 2);
  put(out, 16, 2);
  std::fwrite("data", 1, 4, out);
  put(out, bytes, 4);
}

std::string SoundOut::close() {
  if (out_ == nullptr) return "";
  std::fseek(file(out_), 0, SEEK_SET);
  header();
  std::fclose(file(out_));
  out_ = nullptr;
  failed_ = true;  // one file a run
  return file_;
}

}  // namespace btr::openr
