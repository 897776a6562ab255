#include "core/camera/truth_file.h"

#include <cmath>

#include "core/spec/csv.h"
#include "core/spec/json_reader.h"
#include "core/spec/parameter.h"
#include "core/spec/require.h"

namespace btr {
namespace {

constexpr const char* truthColumns[] = {".pixels",    ".left_px",     ".top_px",      ".right_px",
                                        ".bottom_px", ".centre_x_px", ".centre_y_px", ".distance_m"};

std::string truthFields(const SeenObject* seen) {
  if (!seen) return ",0,,,,,,,";
  std::string text;
  for (const int whole : {seen->pixels, seen->left, seen->top, seen->right, seen->bottom})
    text += "," + std::to_string(whole);
  for (const double number : {seen->centreX_px, seen->centreY_px}) text += "," + toText(number);
  return text + "," + (std::isfinite(seen->distance_m) ? toText(seen->distance_m) : "");
}

}  // namespace

TruthTable::TruthTable(std::vector<std::string> objects, std::vector<std::string> further)
    : objects_(objects.size()), further_(further.size()), csv_("frame,time_s") {
  for (const std::string& name : further) csv_ += "," + csvField(name);
  for (const std::string& name : objects)
    for (const char* column : truthColumns) csv_ += "," + csvField(name + column);
  csv_ += "\n";
}

void TruthTable::add(std::uint64_t frame, double time_s, const PictureTruth& truth, const std::vector<double>& values) {
  require(values.size() == further_, "a row of truth has a value for each further column");
  csv_ += std::to_string(frame) + "," + toText(time_s);
  for (const double value : values) csv_ += "," + (std::isfinite(value) ? toText(value) : std::string());
  auto seen = truth.seen.begin();
  for (std::size_t object = 1; object <= objects_; ++object) {
    while (seen != truth.seen.end() && seen->object < object) ++seen;
    csv_ += truthFields(seen != truth.seen.end() && seen->object == object ? &*seen : nullptr);
  }
  csv_ += "\n";
}

void TruthTable::write(const std::string& path) const { writeFile(path, csv_); }

}  // namespace btr
