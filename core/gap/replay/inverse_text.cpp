#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/inverse_text.h"

namespace btr {
namespace {

struct Sum {
  double errors = 0, recorded = 0;
  std::size_t recordings = 0;
  double relative() const { return recorded > 0 ? 100 * std::sqrt(errors / recorded) : 0; }
};

/// By channel, over all recordings.
std::map<std::string, Sum> sums(const InverseReport& report) {
  std::map<std::string, Sum> byChannel;
  for (const InverseError& joint : report.joints) {
    Sum& sum = byChannel[joint.error.channel];
    const auto samples = static_cast<double>(joint.error.samples);
    sum.errors += samples * joint.error.rootMeanSquare * joint.error.rootMeanSquare;
    sum.recorded += samples * joint.rootMeanSquare_recorded * joint.rootMeanSquare_recorded;
    ++sum.recordings;
  }
  return byChannel;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

}  // namespace

std::string inverseTable(const InverseReport& report) {
  std::size_t widestName = 9, widestChannel = 7;
  const auto name = [](const InverseError& joint) {
    return std::filesystem::path(joint.error.recording).filename().string();
  };
  for (const InverseError& joint : report.joints) {
    widestName = std::max(widestName, name(joint).size());
    widestChannel = std::max(widestChannel, joint.error.channel.size());
  }
  std::string text = padded("recording", widestName) + "  " + padded("channel", widestChannel) +
                     "   samples  RMS recorded     RMS error  relative [%]\n";
  const auto row = [&](const std::string& first, const std::string& channel, const std::string& numbers) {
    text += padded(first, widestName) + "  " + padded(channel, widestChannel) + numbers + "\n";
  };
  std::array<char, 128> numbers{};
  for (const InverseError& joint : report.joints) {
    std::snprintf(numbers.data(), numbers.size(), "%10zu%14.4g%14.4g%14.4g", joint.error.samples,
                  joint.rootMeanSquare_recorded, joint.error.rootMeanSquare, joint.relative);
    row(name(joint), joint.error.channel, numbers.data());
  }
  for (const auto& [channel, sum] : sums(report)) {
    if (sum.recordings < 2) continue;
    std::snprintf(numbers.data(), numbers.size(), "%52.4g", sum.relative());
    row("all " + std::to_string(sum.recordings), channel, numbers.data());
  }
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  return text;
}

std::string toJsonText(const InverseReport& report) {
  nlohmann::json document{
      {"format", "uchilsim-inverse-1"}, {"joints", nlohmann::json::array()}, {"notes", report.notes}};
  for (const InverseError& joint : report.joints)
    document["joints"].push_back({{"recording", joint.error.recording},
                                  {"channel", joint.error.channel},
                                  {"unit", unitOfChannel(joint.error.channel)},
                                  {"samples", joint.error.samples},
                                  {"root_mean_square_recorded", joint.rootMeanSquare_recorded},
                                  {"root_mean_square_error", joint.error.rootMeanSquare},
                                  {"relative_error_percent", joint.relative}});
  for (const auto& [channel, sum] : sums(report))
    document["all"].push_back({{"channel", channel}, {"relative_error_percent", sum.relative()}});
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace btr
