#include <nlohmann/json.hpp>

#include "core/run/reality/fitness_clues.h"
#include "core/spec/error.h"

namespace btr {

using nlohmann::json;

std::string toJsonText(const FitnessClues& c) {
  json clues = json::array();
  for (const FitnessClue& clue : c.clues)
    clues.push_back({{"effect", clue.effect.effect},
                     {"at", clue.effect.at},
                     {"parameters", clue.effect.parameters},
                     {"share", clue.share},
                     {"p_value", clue.pValue},
                     {"simulated", clue.simulated}});
  return json{{"format", "uchilsim-fitness-clues-1"},
              {"run", c.run},
              {"stage", c.stage},
              {"simulator", c.version},
              {"unit", c.unit},
              {"individuals", c.individuals},
              {"real", c.real},
              {"simulated", c.simulated},
              {"standard_error", c.standardError},
              {"gap", c.gap},
              {"tried", c.tried},
              {"alike", c.alike},
              {"record",
               {{"individual", c.recordIndividual},
                {"channel", c.recordChannel},
                {"unit", c.recordUnit},
                {"spread", c.recordSpread}}},
              {"sentence", c.sentence},
              {"clues", clues}}
      .dump(1);
}

FitnessClues fitnessCluesFromJson(const std::string& text) {
  try {
    const json j = json::parse(text);
    FitnessClues c;
    c.run = j.at("run");
    c.stage = j.at("stage");
    c.version = j.at("simulator");
    c.unit = j.at("unit");
    j.at("individuals").get_to(c.individuals);
    j.at("real").get_to(c.real);
    j.at("simulated").get_to(c.simulated);
    j.at("standard_error").get_to(c.standardError);
    c.gap = j.at("gap");
    c.tried = j.at("tried");
    c.alike = j.at("alike");
    const json& record = j.at("record");
    c.recordIndividual = record.at("individual");
    c.recordChannel = record.at("channel");
    c.recordUnit = record.at("unit");
    c.recordSpread = record.at("spread");
    c.sentence = j.at("sentence");
    for (const json& clue : j.at("clues"))
      c.clues.push_back({{clue.at("effect"), clue.at("at"), clue.at("parameters").get<Values>()},
                         clue.at("share"),
                         clue.at("p_value"),
                         clue.at("simulated").get<std::vector<double>>()});
    return c;
  } catch (const json::exception& error) {
    throw InputError("fitness clues: " + std::string(error.what()));
  }
}

}  // namespace btr
