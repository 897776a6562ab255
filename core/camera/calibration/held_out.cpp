#include "core/camera/calibration/held_out.h"

#include <cmath>

#include "core/spec/random.h"

namespace btr {

std::vector<bool> heldOutPhotos(std::size_t count, const TwinOptions& options) {
  const double share = options.heldOutShare * static_cast<double>(count);
  const std::size_t wanted = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(share)));
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  Random random = Random::forPurpose(options.seed, "held-out photographs");
  for (std::size_t i = count; i-- > 1;) std::swap(order[i], order[random.below(i + 1)]);
  std::vector<bool> held(count, false);
  for (std::size_t i = 0; i < std::min(wanted, count); ++i) held[order[i]] = true;
  return held;
}

double rootMeanSquare(const std::vector<TwinPhoto>& photos, bool heldOut, bool before) {
  double square = 0, count = 0;
  for (const TwinPhoto& photo : photos)
    if (photo.heldOut == heldOut) {
      square += std::pow(before ? photo.before : photo.after, 2);
      ++count;
    }
  return count > 0 ? std::sqrt(square / count) : 0;
}

}  // namespace btr
