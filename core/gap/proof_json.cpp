// Blind cases and their score as JSON.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gap/proof_score.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using nlohmann::json;
constexpr const char* caseFormat = "uchilsim-proved-case-1";

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

}  // namespace

std::string toJsonText(const ProvedCase& proved) {
  json document{{"format", caseFormat},
                {"answer", toJsonText(proved.answer)},
                {"failure", proved.failure},
                {"verdict", proved.verdict},
                {"accepted", json::array()},
                {"remainder_at", proved.remainderAt},
                {"worst_channel", proved.worstChannel},
                {"heldout_rmse", proved.heldOut},
                {"calibrated", proved.calibrated},
                {"seconds", proved.seconds}};
  for (const auto& named : proved.accepted) {
    json entry{{"effect", named.placed.effect},
               {"at", named.placed.at},
               {"parameters", named.placed.parameters},
               {"rivals", json::array()}};
    for (const PlacedEffect& rival : named.rivals)
      entry["rivals"].push_back({{"effect", rival.effect}, {"at", rival.at}});
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
    entry.array("rivals", [&](JsonReader rival) {
      named.rivals.push_back({rival.text("effect"), rival.text("at"), {}});
      rival.finish();
    });
    entry.finish();
    proved.accepted.push_back(std::move(named));
  });
  proved.remainderAt = reader.text("remainder_at", "");
  proved.worstChannel = reader.text("worst_channel", "");
  proved.heldOut = reader.anyValues("heldout_rmse");
  proved.calibrated = reader.anyValues("calibrated");
  proved.seconds = reader.number("seconds", 0, 1e9);
  reader.finish();
  return proved;
}

std::string proofJson(const ProofScore& score, const std::vector<ProvedCase>& cases) {
  json document{{"format", "uchilsim-proof-1"},      {"all", toJson(score.all)},
                {"by_scene", toJson(score.byScene)}, {"by_kind", toJson(score.byKind)},
                {"by_cost", toJson(score.byCost)},   {"bars", json::array()},
                {"confusion", json::array()},        {"cases", json::array()}};
  for (const ProofBar& bar : score.bars)
    document["bars"].push_back({{"question", bar.question},
                                {"wanted", bar.wanted},
                                {"found", bar.found},
                                {"met", bar.asked ? json(bar.met) : json(nullptr)}});
  for (const auto& [pair, count] : score.confusion)
    document["confusion"].push_back({{"hidden", pair.first}, {"said", pair.second}, {"cases", count}});
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
                                 {"heldout_over_noise", marks.heldOut ? orNull(*marks.heldOut) : json(nullptr)},
                                 {"seconds", proved.seconds}});
  }
  return document.dump(2) + "\n";
}

}  // namespace btr
