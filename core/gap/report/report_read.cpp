// report.json back into a value. What is not in it stands in the tables beside it (report_files.cpp).
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/gap/report/interval_json.h"
#include "core/gap/report/report_read.h"
#include "core/gap/report/report_text.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using Ordered = nlohmann::ordered_json;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double numberOf(JsonReader& r, const std::string& key) { return r.numberOrNull(key, unknown); }

std::vector<GapReport::Interval> intervalsOf(JsonReader& r, const std::string& key) {
  std::vector<GapReport::Interval> all;
  const nlohmann::json* list = r.any(key);
  if (list && !list->is_array()) r.refuse(key, "a list of pairs, from and to");
  if (list)
    for (const nlohmann::json& pair : *list) all.push_back(intervalFrom(pair, r, key));
  return all;
}

/// Calls `each(name, reader)` for the members of an object in the order of the file, which is the report's own.
template <class Each>
void inOrder(JsonReader& r, const std::string& key, const Ordered& ordered, const Each& each) {
  JsonReader members = r.object(key);
  for (const auto& [name, value] : ordered.at(key).items()) each(name, members.object(name));
}

GapReport::Number numberFrom(JsonReader& r, const std::string& name, bool calibrated) {
  GapReport::Number n;
  n.name = name;
  n.before = numberOf(r, calibrated ? "before" : "neutral");
  n.value = numberOf(r, calibrated ? "after" : "value");
  n.ci95 = intervalFrom(r, "ci95");
  n.amongRivals = intervalFrom(r, "ci95_among_rivals");
  n.atBound = r.flag("at_bound", false);
  n.excited = r.flag("excited", true);
  n.unit = r.text("unit", "");
  r.finish();
  return n;
}

/// That of `all` whose text stands under the key; any other text is refused.
template <class Choice>
Choice oneOf(JsonReader& r, const std::string& key, const std::vector<Choice>& all) {
  std::vector<std::string> words;
  for (const Choice choice : all) words.emplace_back(toText(choice));
  const std::string word = r.word(key, words);
  return all[static_cast<std::size_t>(std::ranges::find(words, word) - words.begin())];
}

EffectLaw effectLawFrom(JsonReader r) {
  using Acts = EffectLaw::Acts;
  EffectLaw law;
  law.acts = oneOf<Acts>(r, "acts_on",
                         {Acts::notSaid, Acts::command, Acts::drive, Acts::gear, Acts::joint, Acts::link, Acts::gravity,
                          Acts::air, Acts::contact, Acts::sensor});
  law.says = r.text("says");
  law.equation = r.text("equation");
  law.symbols = r.text("symbols");
  law.source = r.text("source");
  r.finish();
  return law;
}

GapReport::Effect effectFrom(JsonReader& r, const Ordered& ordered) {
  GapReport::Effect e;
  e.effect = r.text("effect");
  e.at = r.text("at");
  inOrder(r, "parameters", ordered,
          [&](const std::string& name, JsonReader number) { e.parameters.push_back(numberFrom(number, name, false)); });
  e.heldoutErrorReduction = numberOf(r, "heldout_error_reduction");
  e.pValue = numberOf(r, "p_value");
  if (r.any("q_value")) e.qValue = numberOf(r, "q_value");
  r.array("indistinguishable_from", [&](JsonReader rival) {
    e.rivals.push_back({rival.text("effect"), rival.text("at"), numberOf(rival, "heldout_error_ratio"),
                        rival.text("together_with", "")});
    rival.finish();
  });
  e.accepted = r.flag("accepted", false);
  e.reason = r.text("reason", "");
  e.screenRank = static_cast<int>(r.integer("screen_rank", 0, 1'000'000'000, 0));
  e.screenShare = numberOf(r, "screen_share");
  if (r.any("law")) e.law = effectLawFrom(r.object("law"));
  r.finish();
  return e;
}

GapReport::Located locatedFrom(JsonReader& r) {
  GapReport::Located located;
  located.channel = r.text("channel");
  located.shareOfExcess = numberOf(r, "share_of_excess_error");
  located.when = r.text("when");
  located.dependsOn = r.texts("depends_on");
  r.array("regimes", [&](JsonReader regime) {
    located.regimes.push_back({regime.text("name"), numberOf(regime, "share_of_excess_error"),
                               numberOf(regime, "share_of_time"), numberOf(regime, "p_value")});
    regime.finish();
  });
  const std::vector<GapReport::Interval> times = intervalsOf(r, "windows_s");
  const std::vector<double> places = r.numberList("window_trials");
  if (places.size() != times.size()) r.refuse("window_trials", "one trial a window, counted from 0");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!(places[i] >= 0 && places[i] < 1e6)) r.refuse("window_trials", "one trial a window, counted from 0");
    located.windows.push_back({static_cast<std::size_t>(places[i]), times[i]});
  }
  r.finish();
  return located;
}

GapReport::Channel channelFrom(JsonReader& r, const std::string& name) {
  GapReport::Channel c;
  c.name = name;
  c.asGiven = numberOf(r, "rmse_as_given");
  c.calibrated = numberOf(r, "rmse_calibrated");
  c.withEffects = numberOf(r, "rmse_with_effects");
  c.noiseFloor = numberOf(r, "noise_floor");
  if (r.has("recordings_noise_floor")) c.heldoutNoiseFloor = numberOf(r, "recordings_noise_floor");
  c.maeAsGiven = numberOf(r, "mae_as_given");
  c.maeCalibrated = numberOf(r, "mae_calibrated");
  c.maeWithEffects = numberOf(r, "mae_with_effects");
  c.heldoutAsGiven = numberOf(r, "recordings_rmse_as_given");
  c.heldoutCalibrated = numberOf(r, "recordings_rmse_calibrated");
  c.heldoutWithEffects = numberOf(r, "recordings_rmse_with_effects");
  c.heldoutMaeAsGiven = numberOf(r, "recordings_mae_as_given");
  c.heldoutMaeCalibrated = numberOf(r, "recordings_mae_calibrated");
  c.heldoutMaeWithEffects = numberOf(r, "recordings_mae_with_effects");
  c.stepError = numberOf(r, "step_error");
  c.unit = r.text("unit", "");
  r.finish();
  return c;
}

GapReport::Trial trialFrom(JsonReader& r, std::vector<std::string>& overlays) {
  GapReport::Trial trial;
  trial.name = r.text("name");
  trial.sha256 = r.text("sha256");
  trial.heldOut = r.flag("held_out", false);
  trial.setAside = r.flag("set_aside", false);
  const std::string overlay = r.text("overlay");
  // A report may come from anywhere: it may name only files of its own folder.
  if (!overlay.starts_with("overlay/") || overlay.size() == 8 || overlay.find('/', 8) != std::string::npos)
    r.refuse("overlay", "a file of the report's own folder, overlay/NAME.csv");
  overlays.push_back(overlay);
  r.array("series", [&](JsonReader s) {
    trial.series.push_back({s.text("channel"), s.text("unit"), numberOf(s, "noise_floor"), {}, {}, {}, {}});
    s.finish();
  });
  r.any("held_out_blocks_s");  // always empty, in reports of the first development versions
  r.finish();
  return trial;
}

GapReport::LawCurve lawCurveFrom(JsonReader& r) {
  GapReport::LawCurve c;
  c.on = r.text("on");
  c.unitX = r.text("unit_x");
  c.unitY = r.text("unit_y");
  c.x = r.numberList("x");
  c.y = r.numberList("y");
  c.low = r.numberList("low");
  c.high = r.numberList("high");
  for (const auto& [key, list] : {std::pair{"y", &c.y}, {"low", &c.low}, {"high", &c.high}})
    if (list->size() != c.x.size()) r.refuse(key, "as many numbers as x has");
  r.finish();
  return c;
}

GapReport::MeasuredLaw lawFrom(JsonReader r) {
  GapReport::MeasuredLaw law;
  law.at = r.text("at");
  law.family = r.text("family", "");
  law.sentence = r.text("sentence");
  r.array("curves", [&](JsonReader curve) { law.curves.push_back(lawCurveFrom(curve)); });
  law.shareOfRest = numberOf(r, "share_of_rest");
  law.explainedShare = numberOf(r, "explained_share");
  law.pValue = numberOf(r, "p_value");
  law.error = numberOf(r, "error_in_noise_floors");
  law.errorWithout = numberOf(r, "error_without_in_noise_floors");
  r.finish();
  return law;
}

GapReport::Disagreement disagreementFrom(JsonReader& r) {
  GapReport::Disagreement d;
  d.trial = r.text("trial");
  d.sha256 = r.text("sha256");
  d.what = r.text("what");
  d.setAside = r.flag("set_aside", true);
  d.error = numberOf(r, "error_in_noise_floors");
  d.errorAlone = numberOf(r, "error_alone_in_noise_floors");
  d.errorOfOthers = numberOf(r, "error_of_others_in_noise_floors");
  r.finish();
  return d;
}

GapReport::Remainder remainderFrom(JsonReader r, GapReport::MeasuredLaw& law) {
  GapReport::Remainder m;
  if (const nlohmann::json* value = r.any("law"); value && !value->is_null()) law = lawFrom(r.object("law"));
  m.explainedShare = numberOf(r, "explained_share");
  if (const nlohmann::json* value = r.any("shape"); value && !value->is_null()) {
    JsonReader shape = r.object("shape");
    m.at = shape.text("at");
    m.on = shape.text("on");
    m.unitX = shape.text("unit_x");
    m.unitY = shape.text("unit_y");
    m.x = shape.numberList("x");
    m.y = shape.numberList("y");
    m.standardError = shape.numberList("standard_error");
    if (m.y.size() != m.x.size()) shape.refuse("y", "as many numbers as x has");
    if (!m.standardError.empty() && m.standardError.size() != m.x.size())
      shape.refuse("standard_error", "as many numbers as x has, or none");
    m.shareOfRest = numberOf(shape, "share_of_rest");
    m.pValue = numberOf(shape, "p_value");
    shape.finish();
  }
  r.finish();
  return m;
}

GapReport::Verdict verdictOf(JsonReader& r) {
  using Verdict = GapReport::Verdict;
  return oneOf<Verdict>(r, "verdict",
                        {Verdict::noMismatch, Verdict::parametersSuffice, Verdict::missingPhysics,
                         Verdict::partlyExplained, Verdict::unexplained, Verdict::notExcited});
}

SimulatorSpec simulatorOf(JsonReader r) {
  SimulatorSpec simulator = simulatorFromReader(r);
  r.finish();
  return simulator;
}

}  // namespace

GapReport reportFromJson(const std::string& text, const std::string& place, std::vector<std::string>& overlays) {
  JsonReader r = JsonReader::parse(text, place);
  r.word("format", {"uchilsim-gap-report-1"});
  GapReport report;
  report.verdict = verdictOf(r);
  if (r.any("explained_share")) report.explainedShare = numberOf(r, "explained_share");
  report.sentence = r.text("sentence");
  report.nextStep = r.text("next_step", "");
  r.array("located", [&](JsonReader entry) { report.located.push_back(locatedFrom(entry)); });
  // The accepted ones stand among all that were tried.
  r.array("effects", [](JsonReader) {});
  // The strict reader has accepted the text; this one keeps the order of names.
  const auto ordered = Ordered::parse(text);
  r.array("tried",
          [&](JsonReader entry) { report.tried.push_back(effectFrom(entry, ordered["tried"][report.tried.size()])); });
  inOrder(r, "calibrated", ordered, [&](const std::string& name, JsonReader number) {
    report.calibrated.push_back(numberFrom(number, name, true));
  });
  JsonReader heldOut = r.object("heldout");
  inOrder(heldOut, "channels", ordered["heldout"],
          [&](const std::string& name, JsonReader channel) { report.channels.push_back(channelFrom(channel, name)); });
  heldOut.finish();
  report.remainder = remainderFrom(r.object("remainder"), report.law);

  JsonReader next = r.object("next_recording");
  report.next.why = next.text("why");
  report.next.separation = numberOf(next, "separation");
  if (const nlohmann::json* file = next.any("command_csv"); file && !file->is_null()) {
    next.word("command_csv", {"next_command.csv"});
    report.next.columns.emplace_back();  // tells that there is a table to read
  }
  next.finish();

  JsonReader provenance = r.object("provenance");
  report.seed = provenance.seed("seed", 1);
  report.version = provenance.text("version");
  provenance.texts("recordings_sha256");
  report.seconds = numberOf(provenance, "wall_time_s");
  report.scene = provenance.text("scene", "");
  report.sceneSha256 = provenance.text("scene_sha256", "");
  provenance.finish();

  r.array("ladder", [&](JsonReader step) {
    report.ladder.push_back(
        {step.text("what"), numberOf(step, "error_in_noise_floors"), numberOf(step, "standard_error")});
    step.finish();
  });
  r.array("trials", [&](JsonReader trial) { report.trials.push_back(trialFrom(trial, overlays)); });
  r.array("disagreeing_trials", [&](JsonReader d) { report.disagreements.push_back(disagreementFrom(d)); });
  for (const GapReport::Located& located : report.located)
    for (const GapReport::Window& window : located.windows)
      if (window.recording >= report.trials.size())
        throw InputError(place + " /located " + located.channel, "trial " + std::to_string(window.recording),
                         "below " + std::to_string(report.trials.size()));
  report.strongCorrelations = r.texts("strong_correlations");
  report.cutShort = r.flag("cut_short", false);
  report.notes = r.texts("notes");
  report.before = simulatorOf(r.object("simulator_before"));
  report.after = simulatorOf(r.object("simulator_after"));
  r.finish();
  return report;
}

}  // namespace btr
