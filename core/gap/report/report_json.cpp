// The report as report.json: the contract's keys, and ours beside them (resources/manual/formats/gap-report.md).
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/report/interval_json.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_text.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using json = nlohmann::ordered_json;

/// JSON knows neither NaN nor infinity: null stands for them.
json finite(double value) { return std::isfinite(value) ? json(value) : json(); }
json listOf(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values) list.push_back(finite(value));
  return list;
}
json simulatorOf(const SimulatorSpec& simulator) { return json::parse(simulatorToJson(simulator).dump()); }

json toJson(const GapReport::Located& located) {
  json regimes = json::array(), windows = json::array(), places = json::array();
  for (const GapReport::Regime& r : located.regimes)
    regimes.push_back({{"name", r.name},
                       {"share_of_excess_error", finite(r.shareOfExcess)},
                       {"share_of_time", finite(r.shareOfTime)},
                       {"p_value", finite(r.pValue)}});
  for (const GapReport::Window& w : located.windows) {
    windows.push_back(json(btr::toJson(w.time_s)));
    places.push_back(w.recording);
  }
  return {{"channel", located.channel}, {"share_of_excess_error", finite(located.shareOfExcess)},
          {"when", located.when},       {"windows_s", windows},
          {"window_trials", places},    {"depends_on", located.dependsOn},
          {"regimes", regimes}};
}

json toJson(const GapReport::Number& n, bool calibrated) {
  json number;
  if (calibrated) {
    number["before"] = finite(n.before);
    number["after"] = finite(n.value);
  } else {
    number["value"] = finite(n.value);
    number["neutral"] = finite(n.before);
  }
  number["ci95"] = json(btr::toJson(n.ci95));
  if (n.amongRivals.known()) number["ci95_among_rivals"] = json(btr::toJson(n.amongRivals));
  number["at_bound"] = n.atBound;
  number["excited"] = n.excited;
  number["unit"] = n.unit;
  return number;
}

json toJson(const std::vector<GapReport::Number>& numbers, bool calibrated) {
  json object = json::object();
  for (const GapReport::Number& n : numbers) object[n.name] = toJson(n, calibrated);
  return object;
}

json toJson(const GapReport::Effect& e) {
  json rivals = json::array();
  for (const GapReport::Rival& r : e.rivals) {
    rivals.push_back({{"effect", r.effect}, {"at", r.at}, {"heldout_error_ratio", finite(r.heldoutErrorRatio)}});
    if (!r.with.empty()) rivals.back()["together_with"] = r.with;
  }
  json effect{{"effect", e.effect},
              {"at", e.at},
              {"parameters", toJson(e.parameters, false)},
              {"heldout_error_reduction", finite(e.heldoutErrorReduction)},
              {"p_value", finite(e.pValue)},
              {"q_value", finite(e.qValue)},
              {"indistinguishable_from", rivals},
              {"accepted", e.accepted},
              {"reason", e.reason},
              {"screen_rank", e.screenRank},
              {"screen_share", finite(e.screenShare)}};
  if (!e.law.says.empty())
    effect["law"] = {{"acts_on", toText(e.law.acts)},
                     {"says", e.law.says},
                     {"equation", e.law.equation},
                     {"symbols", e.law.symbols},
                     {"source", e.law.source}};
  return effect;
}

json toJson(const GapReport::Channel& c) {
  json channel = {{"rmse_as_given", finite(c.asGiven)},
                  {"rmse_calibrated", finite(c.calibrated)},
                  {"rmse_with_effects", finite(c.withEffects)},
                  {"noise_floor", finite(c.noiseFloor)},
                  {"mae_as_given", finite(c.maeAsGiven)},
                  {"mae_calibrated", finite(c.maeCalibrated)},
                  {"mae_with_effects", finite(c.maeWithEffects)},
                  {"recordings_rmse_as_given", finite(c.heldoutAsGiven)},
                  {"recordings_rmse_calibrated", finite(c.heldoutCalibrated)},
                  {"recordings_rmse_with_effects", finite(c.heldoutWithEffects)},
                  {"recordings_mae_as_given", finite(c.heldoutMaeAsGiven)},
                  {"recordings_mae_calibrated", finite(c.heldoutMaeCalibrated)},
                  {"recordings_mae_with_effects", finite(c.heldoutMaeWithEffects)},
                  {"step_error", finite(c.stepError)},
                  {"unit", c.unit}};
  if (c.heldoutNoiseFloor > 0) channel["recordings_noise_floor"] = finite(c.heldoutNoiseFloor);
  return channel;
}

json toJson(const GapReport::Trial& trial, const std::string& overlay) {
  json series = json::array();
  for (const GapReport::Series& s : trial.series)
    series.push_back({{"channel", s.channel}, {"unit", s.unit}, {"noise_floor", finite(s.noiseFloor)}});
  return {{"name", trial.name},          {"sha256", trial.sha256}, {"held_out", trial.heldOut},
          {"set_aside", trial.setAside}, {"overlay", overlay},     {"series", series}};
}

json toJson(const GapReport::MeasuredLaw& law) {
  if (!law.known()) return {};
  json curves = json::array();
  for (const GapReport::LawCurve& c : law.curves)
    curves.push_back({{"on", c.on},
                      {"unit_x", c.unitX},
                      {"unit_y", c.unitY},
                      {"x", listOf(c.x)},
                      {"y", listOf(c.y)},
                      {"low", listOf(c.low)},
                      {"high", listOf(c.high)}});
  return {{"at", law.at},
          {"family", law.family},
          {"sentence", law.sentence},
          {"curves", curves},
          {"share_of_rest", finite(law.shareOfRest)},
          {"explained_share", finite(law.explainedShare)},
          {"p_value", finite(law.pValue)},
          {"error_in_noise_floors", finite(law.error)},
          {"error_without_in_noise_floors", finite(law.errorWithout)}};
}

json toJson(const GapReport::Disagreement& d) {
  return {{"trial", d.trial},
          {"sha256", d.sha256},
          {"what", d.what},
          {"set_aside", d.setAside},
          {"error_in_noise_floors", finite(d.error)},
          {"error_alone_in_noise_floors", finite(d.errorAlone)},
          {"error_of_others_in_noise_floors", finite(d.errorOfOthers)}};
}

json toJson(const GapReport::Remainder& r, const GapReport::MeasuredLaw& law) {
  json shape;
  if (!r.on.empty())
    shape = {{"at", r.at},
             {"on", r.on},
             {"unit_x", r.unitX},
             {"unit_y", r.unitY},
             {"x", listOf(r.x)},
             {"y", listOf(r.y)},
             {"standard_error", listOf(r.standardError)},
             {"share_of_rest", finite(r.shareOfRest)},
             {"p_value", finite(r.pValue)}};
  return {{"explained_share", finite(r.explainedShare)}, {"shape", shape}, {"law", toJson(law)}};
}

}  // namespace

std::string toJsonText(const GapReport& report) {
  json document{{"format", "uchilsim-gap-report-1"},
                {"verdict", toText(report.verdict)},
                {"explained_share", finite(report.explainedShare)},
                {"sentence", report.sentence},
                {"next_step", report.nextStep}};
  for (const char* list : {"located", "effects"}) document[list] = json::array();
  for (const GapReport::Located& located : report.located) document["located"].push_back(toJson(located));
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted) document["effects"].push_back(toJson(effect));
  document["calibrated"] = toJson(report.calibrated, true);
  document["heldout"]["channels"] = json::object();
  for (const GapReport::Channel& channel : report.channels)
    document["heldout"]["channels"][channel.name] = toJson(channel);
  document["remainder"] = toJson(report.remainder, report.law);
  document["next_recording"] = {{"why", report.next.why},
                                {"command_csv", report.next.columns.empty() ? json() : json("next_command.csv")},
                                {"separation", finite(report.next.separation)}};
  document["provenance"] = {{"seed", report.seed},
                            {"version", report.version},
                            {"recordings_sha256", json::array()},
                            {"wall_time_s", finite(report.seconds)},
                            {"scene", report.scene},
                            {"scene_sha256", report.sceneSha256}};
  for (const GapReport::Trial& trial : report.trials)
    document["provenance"]["recordings_sha256"].push_back(trial.sha256);

  // Beyond the contract.
  for (const char* list : {"tried", "ladder", "trials", "disagreeing_trials"}) document[list] = json::array();
  for (const GapReport::Effect& effect : report.tried) document["tried"].push_back(toJson(effect));
  for (const GapReport::Step& step : report.ladder)
    document["ladder"].push_back({{"what", step.what},
                                  {"error_in_noise_floors", finite(step.error)},
                                  {"standard_error", finite(step.standardError)}});
  for (std::size_t i = 0; i < report.trials.size(); ++i)
    document["trials"].push_back(toJson(report.trials[i], "overlay/" + overlayFileName(report, i)));
  for (const GapReport::Disagreement& d : report.disagreements) document["disagreeing_trials"].push_back(toJson(d));
  document["strong_correlations"] = report.strongCorrelations;
  if (report.cutShort) document["cut_short"] = true;
  document["notes"] = report.notes;
  document["simulator_before"] = simulatorOf(report.before);
  document["simulator_after"] = simulatorOf(report.after);
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string overlayFileName(const GapReport& report, std::size_t trial) {
  const auto fit = [](const std::string& name) {
    std::string result;
    for (const char byte : std::filesystem::path(name).filename().string()) {
      const bool plain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
                         byte == '-' || byte == '_' || byte == '.';
      result += plain ? byte : '_';
    }
    if (result.ends_with(".csv")) result.resize(result.size() - 4);
    result.resize(std::min<std::size_t>(result.size(), 100));
    return result.empty() || result[0] == '.' ? "trial" + result : result;
  };
  // Trials of the same name are told apart by their number.
  const std::string name = fit(report.trials[trial].name);
  for (std::size_t i = 0; i < report.trials.size(); ++i)
    if (i != trial && fit(report.trials[i].name) == name) return name + "-" + std::to_string(trial + 1) + ".csv";
  return name + ".csv";
}

}  // namespace btr
