#include "core/spec/gait_spec.h"

#include <filesystem>

#include "core/spec/json_reader.h"
#include "core/spec/spec_head.h"

namespace btr {

GaitSpec gaitFromJson(const std::string& text, const std::string& place, const std::string& directory) {
  JsonReader reader = JsonReader::parse(text, place);
  GaitSpec gait;
  gait.directory = directory;
  gait.name = nameOfSpec(reader, "uchilsim-gait-1");
  gait.scene = filledText(reader, "scene", "the path of a scene file");
  gait.controller = pluginChoice(reader.object("controller"));
  gait.parameters = reader.anyValues("parameters");
  gait.fitness = pluginChoice(reader.object("fitness"));
  JsonReader real = reader.object("real");
  gait.real = real.number("value", -1e9, 1e9);
  if (gait.real == 0) real.refuse("value", "a number other than 0");
  gait.measured = real.word("kind", {"measured", "commanded"}) == "measured";
  gait.source = real.text("source");
  gait.certainty = real.text("certainty");
  real.finish();
  gait.note = reader.text("note", "");
  reader.finish();
  return gait;
}

GaitSpec loadGait(const std::string& path) {
  return gaitFromJson(readFile(path), path, std::filesystem::path(path).parent_path().string());
}

}  // namespace btr
