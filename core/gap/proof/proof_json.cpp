// Blind cases and their score as JSON.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/report/interval_json.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using nlohmann::json;
constexpr const char* caseFormat = "uchilsim-proved-case-2";

json toJson(const Share& share) {
  return {
      {"hits", share.hits}, {"cases", share.cases}, {"share", share.value()}, {"ci95", {share.low(), share.high()}}};
}

json orNull(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json toJson(const ProofGroup& group) {
  return {{"cases", group.cases},
          {"failed", group.failed},
          {"false_alarms", toJson(group.falseAlarms)},
          {"named", toJson(group.named)},
          {"named_and_nothing_else", toJson(group.alone)},
          {"both_named", toJson(group.bothNamed)},
          {"location", toJson(group.location)},
          {"heldout_within_1_5", toJson(group.heldOutNear)},
          {"outside_confidently_wrong", toJson(group.confidentlyWrong)},
          {"outside_called_unexplained", toJson(group.unexplained)},
          {"numbers_changed_without_need", toJson(group.numbersChanged)},
          {"parameters_in_ci95", toJson(group.parametersCovered)},
          {"calibrated_in_ci95", toJson(group.calibratedCovered)},
          {"parameters_among_rivals", toJson(group.parametersAmongRivals)},
          {"calibrated_among_rivals", toJson(group.calibratedAmongRivals)},
          {"median_heldout_over_noise", orNull(middleOf(group.heldOut))},
          {"median_parameter_error", orNull(middleOf(group.parameterErrors))},
          {"median_calibrated_error", orNull(middleOf(group.calibratedErrors))},
          {"median_seconds", orNull(middleOf(group.seconds))}};
}

json toJson(const std::vector<std::pair<std::string, ProofGroup>>& groups) {
  json object = json::object();
  for (const auto& [name, group] : groups) object[name] = toJson(group);
  return object;
}

json toJson(const std::map<std::string, ProvedCase::Told>& told) {
  json object = json::object();
  for (const auto& [name, number] : told) {
    object[name] = {{"ci95", btr::toJson(number.ci95)}, {"excited", number.excited}};
    if (number.amongRivals.known()) object[name]["ci95_among_rivals"] = btr::toJson(number.amongRivals);
  }
  return object;
}

std::map<std::string, ProvedCase::Told> toldFrom(JsonReader& reader, const std::string& key) {
  std::map<std::string, ProvedCase::Told> told;
  reader.members(key, [&](const std::string& name, JsonReader number) {
    told[name] = {intervalFrom(number, "ci95"), number.flag("excited", true),
                  intervalFrom(number, "ci95_among_rivals")};
    number.finish();
  });
  return told;
}
}  // namespace

std::string toJsonText(const ProvedCase& proved) {
  json document{{"format", caseFormat},
                {"answer", toJsonText(proved.answer)},
                {"failure", proved.failure},
                {"verdict", proved.verdict},
                {"accepted", json::array()},
                {"remainder_at", proved.remainderAt},
                {"worst_channel", proved.worstChannel},
                {"fresh_rmse", proved.fresh},
                {"calibrated", proved.calibrated},
                {"calibrated_told", toJson(proved.calibratedTold)},
                {"seconds", proved.seconds}};
  for (const auto& named : proved.accepted) {
    json entry{{"effect", named.placed.effect},
               {"at", named.placed.at},
               {"parameters", named.placed.parameters},
               {"told", toJson(named.told)},
               {"rivals", json::array()}};
    for (const auto& rival : named.rivals)
      entry["rivals"].push_back({{"effect", rival.effect}, {"at", rival.at}, {"together_with", rival.with}});
    document["accepted"].push_back(std::move(entry));
  }
  return document.dump(2) + "\n";
}

ProvedCase provedFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  reader.word("format", {caseFormat});
  ProvedCase proved;
  proved.answer = answerFromJson(reader.text("answer"), reader.at("answer"));
  proved.failure = reader.text("failure", "");
  proved.verdict = reader.text("verdict", "");
  reader.array("accepted", [&](JsonReader entry) {
    ProvedCase::Named named;
    named.placed = {entry.text("effect"), entry.text("at"), entry.anyValues("parameters")};
    named.told = toldFrom(entry, "told");
    entry.array("rivals", [&](JsonReader rival) {
      named.rivals.push_back({rival.text("effect"), rival.text("at"), rival.text("together_with")});
      rival.finish();
    });
    entry.finish();
    proved.accepted.push_back(std::move(named));
  });
  proved.remainderAt = reader.text("remainder_at", "");
  proved.worstChannel = reader.text("worst_channel", "");
  proved.fresh = reader.anyValues("fresh_rmse");
  proved.calibrated = reader.anyValues("calibrated");
  proved.calibratedTold = toldFrom(reader, "calibrated_told");
  proved.seconds = reader.number("seconds", 0, 1e9);
  reader.finish();
  return proved;
}

std::string proofJson(const ProofScore& score, const std::vector<ProvedCase>& cases) {
  json document{
      {"format", "uchilsim-proof-2"},    {"all", toJson(score.all)},        {"by_scene", toJson(score.byScene)},
      {"by_kind", toJson(score.byKind)}, {"by_cost", toJson(score.byCost)}, {"bars", json::array()},
      {"confusion", json::array()},      {"verdicts", json::array()},       {"cases", json::array()}};
  for (const ProofBar& bar : score.bars)
    document["bars"].push_back({{"question", bar.question},
                                {"wanted", bar.wanted},
                                {"found", bar.found},
                                {"met", bar.asked ? json(bar.met) : json(nullptr)}});
  for (const auto& [pair, count] : score.confusion)
    document["confusion"].push_back({{"hidden", pair.first}, {"said", pair.second}, {"cases", count}});
  for (const auto& [pair, count] : score.verdicts)
    document["verdicts"].push_back({{"kind", pair.first}, {"verdict", pair.second}, {"cases", count}});
  for (const ProvedCase& proved : cases) {
    const CaseMarks marks = mark(proved);
    const auto flag = [](const std::optional<bool>& mark) { return mark ? json(*mark) : json(nullptr); };
    document["cases"].push_back({{"case", proved.answer.number},
                                 {"scene", proved.answer.scene},
                                 {"kind", proved.answer.kind},
                                 {"verdict", proved.verdict},
                                 {"failure", proved.failure},
                                 {"false_alarm", flag(marks.falseAlarm)},
                                 {"named", flag(marks.named)},
                                 {"both_named", flag(marks.bothNamed)},
                                 {"location", flag(marks.location)},
                                 {"numbers_changed", flag(marks.numbersChanged)},
                                 {"heldout_over_noise", marks.heldOut ? orNull(*marks.heldOut) : json(nullptr)},
                                 {"seconds", proved.seconds}});
  }
  return document.dump(2) + "\n";
}

}  // namespace btr
