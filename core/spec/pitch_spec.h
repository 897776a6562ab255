#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/spec/carpet_spec.h"

namespace btr {

class JsonReader;

/// The sizes of a field with two goals about the world's origin; its length lies along x.
struct FieldSpec {
  struct Goals {
    double width_m = 0.6, depth_m = 0.3, height_m = 0.3;  ///< inside; depth 0: not known
    bool operator==(const Goals&) const = default;
  };
  double length_m = 4.2, width_m = 2.7;  ///< between the outer edges of the border lines
  Goals goals;
  bool operator==(const FieldSpec&) const = default;
};

/// What a scene file says that nothing is simulated with: what a referee and eyes need to know.
struct PitchSpec {
  std::optional<FieldSpec> field;
  std::optional<CarpetSpec> carpet;
  bool operator==(const PitchSpec&) const = default;
};

/// The keys "field" and "carpet" of a scene; the others are none of its business. Throws InputError.
PitchSpec pitchFromReader(JsonReader& reader);
/// The same of a scene file's text. `place` begins messages.
PitchSpec pitchFromJson(const std::string& text, const std::string& place);
/// Adds them to a scene's object.
void addTo(nlohmann::json& scene, const PitchSpec& pitch);

/// "field" of a scene or of a referee. Calls finish().
FieldSpec fieldFromReader(JsonReader& reader);
nlohmann::json toJson(const FieldSpec& field);

}  // namespace btr
