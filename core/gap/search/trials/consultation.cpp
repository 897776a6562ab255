#include "core/gap/search/trials/consultation.h"

#include <algorithm>
#include <filesystem>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/doctor/objection.h"
#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/residual_parts.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/sim/model_losses.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/error.h"

namespace btr {
namespace {

constexpr std::size_t mostInSentence = 3;

/// So large a share of the samples is missing that it may itself be what the simulator does not show.
bool missesMany(const RecordingHealth& health, std::size_t rows, double manyMissing) {
  double missing = 0;
  for (const Gap& gap : health.gaps) missing += gap.missing;
  return missing > manyMissing * static_cast<double>(rows);
}

/// What is said of one channel, in all recordings.
struct Grave {
  std::string channel, name, text;  ///< name and words of the first recording that shows it
  std::size_t recordings = 1;
  std::string last = name;  ///< recording that was counted
};

void addGrave(std::vector<Grave>& grave, const std::string& channel, const std::string& name, const std::string& text) {
  const auto known = std::find_if(grave.begin(), grave.end(),
                                  [&](const Grave& each) { return each.channel == channel && each.last != name; });
  if (known == grave.end()) {
    grave.push_back({channel, name, text});
    return;
  }
  ++known->recordings;
  known->last = name;
}

/// "The robot is not simulated as its file says: A; and 2 more (see the notes). ", "" for none.
std::string lossCaveat(const std::vector<std::string>& losses) {
  if (losses.empty()) return "";
  return "The robot is not simulated as its file says: " + losses[0] +
         (losses.size() > 1 ? "; and " + std::to_string(losses.size() - 1) + " more (see the notes)" : "") + ". ";
}

/// "The recordings themselves come first: A; B; and 2 more findings (see the notes). …", "" for none.
std::string caveatOf(const std::vector<Grave>& grave) {
  if (grave.empty()) return "";
  std::string text = "The recordings themselves come first: ";
  for (std::size_t i = 0; i < std::min(grave.size(), mostInSentence); ++i) {
    const std::string more =
        grave[i].recordings > 1 ? " and " + std::to_string(grave[i].recordings - 1) + " more" : std::string();
    text += (i ? "; " : "") + grave[i].name + more + ": " + grave[i].text;
  }
  if (grave.size() > mostInSentence)
    text += "; and " + std::to_string(grave.size() - mostInSentence) + " more findings (see the notes)";
  return text + ". Unless that is mended or known to be so, what follows need not be physics. ";
}

/// With limits of joints as wide as a fit may make them: past those no recording is at fault.
Scene widened(Scene scene, const std::vector<CalibratePath>& calibrated) {
  for (const CalibratePath& path : calibrated) {
    const std::string number = path.path.substr(path.path.rfind('.') + 1);
    if (number.starts_with("upper_")) setByPath(scene, path.path, path.maximum);
    if (number.starts_with("lower_")) setByPath(scene, path.path, path.minimum);
  }
  return scene;
}

}  // namespace

Consultation consult(const GapProblem& problem, const EffectLibrary& library, bool asRecorded,
                     const SearchThresholds::Verdict& thresholds) {
  const TrialScenes scenes{problem.scene, problem.models, problem.simulator};
  std::vector<Grave> grave;
  std::vector<std::string> notes, others;
  Objection objection;
  for (const auto* list : {&problem.recordings, &problem.heldOut})
    for (const Recording& recording : *list) {
      const std::string name = std::filesystem::path(recording.source).filename().string();
      const Scene scene = widened(scenes.of(recording, library.make), problem.scene.calibrate);
      const Binding binding = bind(scene, recording);
      for (const auto* said : {&recording.notes, &binding.notes})
        for (const std::string& text : *said) others.push_back(name + ": " + text);
      const Diagnosis found = doctor(scene, recording, binding);
      objection.hear(recording.source, recording.mapping, found);
      for (const Finding& finding : found.findings) {
        addGrave(grave, finding.channel, name, finding.text);
        notes.push_back(name + ": " + finding.text);
      }
      const RecordingHealth health = examine(recording);
      const bool broken = missesMany(health, recording.rows(), thresholds.manyMissing);
      if (broken) addGrave(grave, "", name, health.findings.front());
      for (std::size_t i = 0; i < health.findings.size(); ++i)
        (broken && i == 0 ? notes : others).push_back(name + ": " + health.findings[i]);
    }
  if (const auto text = objection.text(); text && !asRecorded)
    throw InputError(*text + "; --as-recorded analyses it regardless");
  joinNotes(notes);
  const std::vector<std::string> losses = modelLosses(problem.scene, problem.models);
  notes.insert(notes.begin(), losses.begin(), losses.end());
  joinNotes(others);
  notes.insert(notes.end(), others.begin(), others.end());
  return {notes, lossCaveat(losses) + caveatOf(grave)};
}

}  // namespace btr
