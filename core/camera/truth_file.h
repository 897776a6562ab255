#pragma once
#include <string>
#include <vector>

#include "core/camera/camera_pipeline.h"

namespace btr {

/// The truth of a sequence of frames as CSV: frame, time_s, the further columns, and for each object NAME.pixels,
/// NAME.left_px, NAME.top_px, NAME.right_px, NAME.bottom_px, NAME.centre_x_px, NAME.centre_y_px, NAME.distance_m (empty
/// but for pixels = 0 where it is not seen).
class TruthTable {
 public:
  /// `objects` as PinholePicture::object counts them; `further` are columns as in recordings
  /// ("red1.neck.position_rad").
  TruthTable(std::vector<std::string> objects, std::vector<std::string> further);

  /// `values` are those of the further columns.
  void add(std::uint64_t frame, double time_s, const PictureTruth& truth, const std::vector<double>& values);
  const std::string& csv() const { return csv_; }
  /// Replaces the file at once. Throws InputError.
  void write(const std::string& path) const;

 private:
  std::size_t objects_, further_;
  std::string csv_;
};

}  // namespace btr
