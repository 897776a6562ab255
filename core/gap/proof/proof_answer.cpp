#include "core/gap/proof/proof_answer.h"

#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"

namespace btr {
namespace {
constexpr const char* answerFormat = "uchilsim-concealed-1";
}

std::string toJsonText(const ConcealedAnswer& answer) {
  nlohmann::json document{{"format", answerFormat},
                          {"seed", answer.seed},
                          {"case", answer.number},
                          {"engine", answer.engine},
                          {"scene", answer.scene},
                          {"kind", answer.kind},
                          {"hidden", nlohmann::json::array()},
                          {"truth", answer.truth},
                          {"noise", answer.noise},
                          {"dirt", answer.dirt},
                          {"spoiled", answer.spoiled},
                          {"salt", answer.salt}};
  for (const auto& hidden : answer.hidden)
    document["hidden"].push_back({{"effect", hidden.placed.effect},
                                  {"at", hidden.placed.at},
                                  {"parameters", hidden.placed.parameters},
                                  {"outside_library", hidden.outside},
                                  {"also_at", hidden.alsoAt},
                                  {"sizes", hidden.sizes},
                                  {"cost_unfitted", hidden.costUnfitted},
                                  {"cost", hidden.cost}});
  return document.dump(2) + "\n";
}

ConcealedAnswer answerFromJson(const std::string& text, const std::string& place) {
  constexpr double largest = 1e12;
  JsonReader reader = JsonReader::parse(text, place);
  reader.word("format", {answerFormat});
  ConcealedAnswer answer;
  answer.seed = reader.seed("seed", 0);
  answer.number = reader.seed("case", 0);
  answer.engine = reader.text("engine");
  answer.scene = reader.text("scene");
  answer.kind = reader.text("kind");
  reader.array("hidden", [&](JsonReader entry) {
    ConcealedAnswer::Hidden hidden;
    hidden.placed.effect = entry.text("effect");
    hidden.placed.at = entry.text("at");
    hidden.placed.parameters = entry.anyValues("parameters");
    hidden.outside = entry.flag("outside_library", false);
    hidden.alsoAt = entry.text("also_at", "");
    hidden.sizes = entry.texts("sizes");
    hidden.costUnfitted = entry.number("cost_unfitted", 0, largest);
    hidden.cost = entry.number("cost", 0, largest);
    entry.finish();
    answer.hidden.push_back(std::move(hidden));
  });
  answer.truth = reader.anyValues("truth");
  answer.noise = reader.anyValues("noise");
  answer.dirt = reader.text("dirt", "");  // trials that were made before there was any do not name it
  answer.spoiled = reader.texts("spoiled");
  answer.salt = reader.text("salt");
  reader.finish();
  return answer;
}

}  // namespace btr
