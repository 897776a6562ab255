#include "core/spec/pitch_spec.h"

#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"

namespace btr {

FieldSpec fieldFromReader(JsonReader& reader) {
  constexpr double least_m = 0.1, most_m = 100;
  FieldSpec field;
  field.length_m = reader.number("length_m", least_m, most_m);
  field.width_m = reader.number("width_m", least_m, most_m);
  JsonReader goals = reader.object("goals");
  field.goals.width_m = goals.number("width_m", least_m, most_m);
  field.goals.depth_m = goals.number("depth_m", 0, most_m, 0);
  field.goals.height_m = goals.number("height_m", least_m, most_m);
  goals.finish();
  reader.finish();
  return field;
}

nlohmann::json toJson(const FieldSpec& field) {
  return {{"length_m", field.length_m},
          {"width_m", field.width_m},
          {"goals",
           {{"width_m", field.goals.width_m}, {"depth_m", field.goals.depth_m}, {"height_m", field.goals.height_m}}}};
}

PitchSpec pitchFromReader(JsonReader& reader) {
  PitchSpec pitch;
  if (auto field = reader.objectIfAny("field")) pitch.field = fieldFromReader(*field);
  if (auto carpet = reader.objectIfAny("carpet")) pitch.carpet = carpetFromReader(*carpet);
  return pitch;
}

PitchSpec pitchFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  return pitchFromReader(reader);
}

void addTo(nlohmann::json& scene, const PitchSpec& pitch) {
  if (pitch.field) scene["field"] = toJson(*pitch.field);
  if (pitch.carpet) scene["carpet"] = toJson(*pitch.carpet);
}

}  // namespace btr
