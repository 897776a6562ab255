#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/residual_text.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr std::size_t tableColumns = 9;
using Row = std::array<std::string, tableColumns>;

/// In a cell of the table; rounding errors are 0.
std::string inCell(double value) { return std::isfinite(value) ? brief(std::abs(value) < 1e-15 ? 0 : value) : "-"; }

std::string fileName(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Characters, not bytes.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

/// The channels' mean over the recordings, in the order in which channels first appear.
std::vector<ChannelError> means(const ResidualReport& report) {
  std::vector<ChannelError> result;
  std::map<std::string, std::pair<std::size_t, double>> places;
  for (const ChannelError& error : report.channels) {
    auto [place, isNew] = places.try_emplace(error.channel, result.size(), 0.0);
    if (isNew) {
      result.emplace_back();
      result.back().channel = error.channel;
    }
    if (error.samples == 0) continue;
    place->second.second += 1;
    ChannelError& mean = result[place->second.first];
    mean.samples += error.samples;
    mean.meanAbsolute += error.meanAbsolute;
    mean.rootMeanSquare += error.rootMeanSquare;
    mean.maximum = std::max(mean.maximum, error.maximum);
    mean.bias += error.bias;
    mean.last += error.last;
    mean.resolution += error.resolution;
    mean.stepError += error.stepError;
  }
  for (ChannelError& mean : result) {
    const double count = std::max(1.0, places[mean.channel].second);
    for (double* value :
         {&mean.meanAbsolute, &mean.rootMeanSquare, &mean.bias, &mean.last, &mean.resolution, &mean.stepError})
      *value /= count;
    mean.recording = "mean of " + inCell(places[mean.channel].second);
  }
  return result;
}

Row rowOf(const ChannelError& error) {
  const auto number = [&](double value) { return error.samples > 0 ? inCell(value) : std::string("-"); };
  return {fileName(error.recording),    error.channel,
          unitOfChannel(error.channel), std::to_string(error.samples),
          number(error.meanAbsolute),   number(error.rootMeanSquare),
          number(error.maximum),        number(error.bias),
          number(error.resolution)};
}

nlohmann::json toJson(const ChannelError& error) {
  nlohmann::json object{{"channel", error.channel}, {"unit", unitOfChannel(error.channel)}, {"samples", error.samples}};
  const auto put = [&](const char* name, double value) {
    object[name] = error.samples > 0 && std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
  };
  put("mean_absolute_error", error.meanAbsolute);
  put("root_mean_square_error", error.rootMeanSquare);
  put("maximum_error", error.maximum);
  put("bias", error.bias);
  put("last_error", error.last);
  put("noise_floor", error.resolution);
  put("step_error", error.stepError);
  return object;
}

}  // namespace

std::string residualTable(const ResidualReport& report) {
  std::vector<Row> rows{
      {"recording", "channel", "unit", "samples", "mean |error|", "RMS", "maximum", "bias", "noise floor"}};
  for (const ChannelError& error : report.channels) rows.push_back(rowOf(error));
  const auto overall = means(report);
  // With one recording the mean would only repeat the rows above.
  if (overall.size() < report.channels.size())
    for (const ChannelError& mean : overall) rows.push_back(rowOf(mean));

  std::array<std::size_t, tableColumns> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < tableColumns; ++i) widths[i] = std::max(widths[i], widthOf(row[i]));
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < tableColumns; ++i) {
      const std::string space(widths[i] - widthOf(row[i]), ' ');
      line += (i ? "  " : "") + (i < 3 ? row[i] + space : space + row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  if (!report.notes.empty()) text += "\n";
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  return text;
}

std::string toJsonText(const ResidualReport& report) {
  nlohmann::json document{{"format", "uchilsim-residual-1"},
                          {"channels", nlohmann::json::array()},
                          {"means", nlohmann::json::array()},
                          {"notes", report.notes}};
  for (const ChannelError& error : report.channels) {
    document["channels"].push_back(toJson(error));
    document["channels"].back()["recording"] = error.recording;
  }
  for (const ChannelError& mean : means(report)) document["means"].push_back(toJson(mean));
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace btr
