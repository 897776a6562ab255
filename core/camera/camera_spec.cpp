// A camera's file.
#include "core/camera/camera_spec.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/spec_head.h"

namespace btr {
namespace {

constexpr int mostSide_px = 4096;
constexpr std::array<const char*, 3> boxChannels{"y", "cb", "cr"};

CameraMount mountFrom(JsonReader reader) {
  CameraMount mount;
  mount.link = filledText(reader, "link", "the name of a link of the robot");
  const auto position = reader.numbers("position_m", 3, {0, 0, 0});
  const auto q = reader.numbers("orientation_wxyz", 4, {1, 0, 0, 0});
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::abs(position[i]) <= 100)) reader.refuse("position_m", "numbers from -100 to 100");
    mount.position_m[i] = position[i];
  }
  for (const double part : q) square += part * part;
  if (!(std::abs(square - 1) <= 0.01)) reader.refuse("orientation_wxyz", "a unit quaternion w, x, y, z");
  // Typed with few digits: made exactly one. What is one already keeps its bits.
  const double length = std::abs(square - 1) > 1e-12 ? std::sqrt(square) : 1;
  for (std::size_t i = 0; i < 4; ++i) mount.orientation_wxyz[i] = q[i] / length;
  reader.finish();
  return mount;
}

StageSettings settingsFrom(JsonReader reader, CameraStage stage) {
  StageSettings settings;
  settings.on = reader.flag("on", true);
  for (const Parameter& p : parametersOf(stage)) {
    if (!reader.any(p.name)) continue;
    if (!p.choices.empty()) {
      const std::string word = reader.word(p.name, p.choices);
      for (std::size_t i = 0; i < p.choices.size(); ++i)
        if (p.choices[i] == word) settings.values[p.name] = static_cast<double>(i);
    } else if (p.integer) {
      settings.values[p.name] = static_cast<double>(
          reader.integer(p.name, static_cast<long long>(p.minimum), static_cast<long long>(p.maximum)));
    } else {
      settings.values[p.name] = reader.number(p.name, p.minimum, p.maximum);
    }
  }
  reader.finish();
  return settings;
}

ColourBox boxFrom(JsonReader reader) {
  ColourBox box;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto bounds = reader.numbers(boxChannels[c], 2, {0, 255});
    for (const double bound : bounds)
      if (!(bound >= 0 && bound <= 255 && bound == std::floor(bound)))
        reader.refuse(boxChannels[c], "least and most, whole numbers 0 to 255");
    if (bounds[0] > bounds[1]) reader.refuse(boxChannels[c], "the least before the most");
    box.least[c] = static_cast<int>(bounds[0]);
    box.most[c] = static_cast<int>(bounds[1]);
  }
  reader.finish();
  return box;
}

ColourClass classFrom(JsonReader reader) {
  ColourClass colour;
  colour.name = filledText(reader, "name", "the name of a colour");
  reader.array("boxes", [&](JsonReader box) { colour.boxes.push_back(boxFrom(std::move(box))); });
  if (colour.boxes.empty()) reader.refuse("boxes", "at least one box");
  reader.finish();
  return colour;
}

nlohmann::json settingsJson(const StageSettings& settings, CameraStage stage) {
  nlohmann::json json = toJson(settings.values, parametersOf(stage));
  if (json.is_null()) json = nlohmann::json::object();
  json["on"] = settings.on;
  return json;
}

nlohmann::json classJson(const ColourClass& colour) {
  nlohmann::json boxes = nlohmann::json::array();
  for (const ColourBox& box : colour.boxes) {
    nlohmann::json one;
    for (std::size_t c = 0; c < 3; ++c) one[boxChannels[c]] = {box.least[c], box.most[c]};
    boxes.push_back(one);
  }
  return {{"name", colour.name}, {"boxes", boxes}};
}

void checkClasses(const CameraSpec& spec, const std::string& place) {
  std::size_t boxes = 0;
  for (const ColourClass& colour : spec.classes) boxes += colour.boxes.size();
  if (spec.classes.size() > mostColourClasses)
    throw InputError(place + " /classes", std::to_string(spec.classes.size()) + " classes",
                     "at most " + std::to_string(mostColourClasses));
  if (boxes > mostColourBoxes)
    throw InputError(place + " /classes", std::to_string(boxes) + " boxes",
                     "at most " + std::to_string(mostColourBoxes));
  if (spec[CameraStage::classes].on && spec.classes.empty())
    throw InputError(place + " /stages/classes", "on without classes", "at least one of /classes");
}

}  // namespace

void check(const CameraSpec& spec, const std::string& place) {
  const auto within = [&](const char* key, double value, double least, double most, const char* unit) {
    check(Parameter{key, unit, "", least, most, least}, value, place + " /" + key);
  };
  within("width_px", spec.width, 8, mostSide_px, "px");
  within("height_px", spec.height, 8, mostSide_px, "px");
  within("focal_px", spec.focal_px, 1, 1e5, "px");
  within("frame_rate_hz", spec.frameRate_hz, 0.1, 1000, "Hz");
  within("centre_px", spec.centreX_px, -mostSide_px, 2 * mostSide_px, "px");
  within("centre_px", spec.centreY_px, -mostSide_px, 2 * mostSide_px, "px");
  for (const CameraStage stage : cameraStages())
    resolve(parametersOf(stage), spec[stage].values, place + " /stages/" + nameOf(stage));
  if (spec[CameraStage::ycbcr].on && spec.width % 2 != 0)
    throw InputError(place + " /width_px", std::to_string(spec.width),
                     "an even number: with ycbcr two neighbours share their colour");
  checkClasses(spec, place);
}

CameraSpec cameraFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  CameraSpec spec;
  spec.name = nameOfSpec(reader, "uchilsim-camera-1");
  spec.width = static_cast<int>(reader.integer("width_px", 8, mostSide_px));
  spec.height = static_cast<int>(reader.integer("height_px", 8, mostSide_px));
  spec.focal_px = reader.number("focal_px", 1, 1e5);
  const auto centre = reader.numbers("centre_px", 2, {(spec.width - 1) / 2.0, (spec.height - 1) / 2.0});
  spec.centreX_px = centre[0];
  spec.centreY_px = centre[1];
  spec.frameRate_hz = reader.number("frame_rate_hz", 0.1, 1000, spec.frameRate_hz);
  if (auto mount = reader.objectIfAny("mount")) spec.mount = mountFrom(std::move(*mount));
  spec.seed = reader.seed("seed", spec.seed);
  if (auto stages = reader.objectIfAny("stages")) {
    for (const CameraStage stage : cameraStages())
      if (auto settings = stages->objectIfAny(nameOf(stage))) spec[stage] = settingsFrom(std::move(*settings), stage);
    stages->finish();
  }
  reader.array("classes", [&](JsonReader colour) { spec.classes.push_back(classFrom(std::move(colour))); });
  spec.notes = reader.texts("notes");
  reader.finish();
  check(spec, place);
  return spec;
}

CameraSpec loadCamera(const std::string& path) { return cameraFromJson(readFile(path), path); }

std::string toJsonText(const CameraSpec& spec) {
  nlohmann::json json{{"format", "uchilsim-camera-1"},
                      {"name", spec.name},
                      {"width_px", spec.width},
                      {"height_px", spec.height},
                      {"focal_px", spec.focal_px},
                      {"centre_px", {spec.centreX_px, spec.centreY_px}},
                      {"frame_rate_hz", spec.frameRate_hz},
                      {"seed", spec.seed}};
  if (!spec.mount.link.empty())
    json["mount"] = {{"link", spec.mount.link},
                     {"position_m", spec.mount.position_m},
                     {"orientation_wxyz", spec.mount.orientation_wxyz}};
  for (const CameraStage stage : cameraStages())
    if (spec[stage].on || !spec[stage].values.empty()) json["stages"][nameOf(stage)] = settingsJson(spec[stage], stage);
  for (const ColourClass& colour : spec.classes) json["classes"].push_back(classJson(colour));
  if (!spec.notes.empty()) json["notes"] = spec.notes;
  return json.dump(1) + "\n";
}

}  // namespace btr
