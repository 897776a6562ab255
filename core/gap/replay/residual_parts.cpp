#include "core/gap/replay/residual_parts.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/gap/recordings/noise_floor.h"
#include "core/gap/replay/overlay.h"
#include "core/gap/replay/residual.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

/// "DIR/sin_sin.leg.knee.position_rad.svg", a number added where two recordings have the same name.
std::string freeName(const ChannelError& error, std::set<std::string>& taken) {
  const std::string stem = std::filesystem::path(error.recording).stem().string() + "." + error.channel;
  std::string name = stem;
  for (int number = 2; !taken.insert(name).second; ++number) name = stem + "-" + std::to_string(number);
  return name + ".svg";
}

}  // namespace

void fillErrors(ChannelError& error, const std::vector<double>& finer) {
  error.resolution = resolution(error.recorded);
  double sum = 0, absolute = 0, squares = 0, steps = 0;
  for (std::size_t i = 0; i < error.simulated.size(); ++i) {
    const double difference = error.simulated[i] - error.recorded[i];
    if (!std::isfinite(difference)) continue;
    ++error.samples;
    error.last = difference;
    sum += difference;
    absolute += std::abs(difference);
    squares += difference * difference;
    error.maximum = std::max(error.maximum, std::abs(difference));
    // The error of a first-order step is twice what halving it changes.
    if (i < finer.size() && std::isfinite(finer[i])) steps += 4 * std::pow(error.simulated[i] - finer[i], 2);
  }
  if (error.samples == 0) return;
  const auto count = static_cast<double>(error.samples);
  error.bias = sum / count;
  error.meanAbsolute = absolute / count;
  error.rootMeanSquare = std::sqrt(squares / count);
  error.stepError = std::sqrt(steps / count);
}

void joinNotes(std::vector<std::string>& notes) {
  std::vector<std::pair<std::string, std::vector<std::string>>> byText;
  for (const std::string& note : notes) {
    const std::size_t colon = note.find(": ");
    const std::string name = note.substr(0, colon), text = note.substr(colon);
    const auto known =
        std::find_if(byText.begin(), byText.end(), [&](const auto& entry) { return entry.first == text; });
    if (known == byText.end()) {
      byText.push_back({text, {name}});
    } else {
      known->second.push_back(name);
    }
  }
  notes.clear();
  for (const auto& [text, names] : byText)
    notes.push_back(names[0] + (names.size() > 1 ? " and " + std::to_string(names.size() - 1) + " more" : "") + text);
}

void writeOverlays(const std::string& folder, const std::vector<ChannelError>& channels) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder)) throw InputError(folder + ": the folder cannot be made");
  std::set<std::string> taken;
  for (const ChannelError& error : channels)
    writeFile((std::filesystem::path(folder) / freeName(error, taken)).string(), overlaySvg(error));
}

}  // namespace btr
