#pragma once
#include <span>
#include <vector>

namespace btr {

/// Butterworth's low-pass filter as a chain of second-order sections (bilinear transform, prewarped).
class LowPass {
 public:
  /// `order` even; 0 < cutoff_hz < rate_hz/2 (asserted).
  LowPass(int order, double cutoff_hz, double rate_hz);

  /// Forward and backward: no delay, the gain squared (−6 dB at the cutoff). The ends are continued by turning the
  /// values about their first and last point. All values must be finite.
  std::vector<double> zeroPhase(std::span<const double> values) const;

 private:
  struct Section {
    double gain, a1, a2;  ///< y = gain·(x + 2x₁ + x₂) − a1·y₁ − a2·y₂
  };
  void run(std::vector<double>& values) const;

  std::vector<Section> sections_;
  std::size_t padding_;
};

}  // namespace btr
