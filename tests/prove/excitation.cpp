#include "tests/prove/excitation.h"

#include <algorithm>
#include <cmath>

#include "tests/prove/blind_world.h"

namespace btr::prove {
namespace {

std::vector<double> multiSine(Random& random, std::size_t rows, double h) {
  struct Tone {
    double frequency, phase, share;
  };
  std::vector<Tone> tones;
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    tones.push_back({drawLog(random, 0.3, 5), random.uniform(0, 2 * M_PI), random.uniform(0.3, 1)});
    tones.back().share /= std::sqrt(tones.back().frequency);
    sum += tones.back().share;
  }
  std::vector<double> command(rows, 0.0);
  for (std::size_t i = 0; i < rows; ++i)
    for (const Tone& tone : tones)
      command[i] +=
          1.4 * tone.share / sum * std::sin(2 * M_PI * tone.frequency * h * static_cast<double>(i) + tone.phase);
  return command;
}

std::vector<double> steps(Random& random, std::size_t rows, double h) {
  std::vector<double> command(rows);
  double level = 0, until = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (h * static_cast<double>(i) >= until) {
      level = random.uniform(-1, 1);
      until += random.uniform(0.25, 0.8);
    }
    command[i] = level;
  }
  return command;
}

std::vector<double> chirp(Random& random, std::size_t rows, double h) {
  const double first = drawLog(random, 0.2, 0.8), last = drawLog(random, 2, 7);
  const double length = h * static_cast<double>(rows);
  std::vector<double> command(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = h * static_cast<double>(i), rise = std::log(last / first);
    command[i] = std::sin(2 * M_PI * first * length / rise * (std::exp(rise * t / length) - 1));
  }
  return command;
}

/// Straight lines between levels; `hold` is the share of time that it stays at each.
std::vector<double> lines(Random& random, std::size_t rows, double h, double hold) {
  std::vector<double> command(rows);
  double from = 0, to = random.uniform(-1, 1), begin = 0, ramp = 0.4, stay = 0.4;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = h * static_cast<double>(i);
    if (t > begin + ramp + stay) {
      begin = t;
      from = to;
      to = random.uniform(-1, 1);
      const double whole = random.uniform(0.5, 1.4);
      stay = hold * whole;
      ramp = whole - stay;
    }
    command[i] = from + (to - from) * std::clamp((t - begin) / ramp, 0.0, 1.0);
  }
  return command;
}

}  // namespace

std::vector<double> drawCommand(Random& random, std::size_t rows, double sample_s, double rest, double size,
                                double still_s) {
  const auto still = static_cast<std::size_t>(std::ceil(still_s / sample_s));
  const std::size_t moving = rows > still ? rows - still : 0;
  std::vector<double> shape;
  switch (random.below(5)) {
    case 0:
      shape = multiSine(random, moving, sample_s);
      break;
    case 1:
      shape = steps(random, moving, sample_s);
      break;
    case 2:
      shape = chirp(random, moving, sample_s);
      break;
    case 3:
      shape = lines(random, moving, sample_s, 0.5);
      break;
    default:
      shape = lines(random, moving, sample_s, 0);
      break;
  }
  std::vector<double> command(rows, rest);
  for (std::size_t i = 0; i < moving; ++i) command[still + i] = rest + size * shape[i];
  return command;
}

std::vector<char> drawPower(Random& random, std::size_t rows, double sample_s) {
  std::vector<char> enabled(rows, 1);
  const double length = sample_s * static_cast<double>(rows);
  double t = random.uniform(0.8, 1.6);
  for (int stretch = 0; stretch < 2 && t < length; ++stretch) {
    const double end = t + random.uniform(0.4, 1.2);
    for (std::size_t i = 0; i < rows; ++i)
      if (const double now = sample_s * static_cast<double>(i); now >= t && now < end) enabled[i] = 0;
    t = end + random.uniform(0.5, 1.2);
  }
  return enabled;
}

}  // namespace btr::prove
