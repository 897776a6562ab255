#include "ui/gap/recording_doctor.h"

#include <QFileInfo>

#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/trial_scenes.h"
#include "ui/common/database/file_state.h"

namespace btr::ui {
namespace {

/// So much is read while the window waits.
constexpr qint64 mostBytes = 8 << 20;

RecordingDoctor::Opinion opinionOf(const QString& recording, const QString& mapping, const QString& scene,
                                   const SceneSpec& spec, const ModelSet& models) {
  RecordingDoctor::Opinion opinion;
  if (QFileInfo(recording).size() > mostBytes) return opinion;
  try {
    const TrialScenes scenes{spec, models, {}};
    for (const Recording& trial : loadTrialsFor(recording.toStdString(), mapping.toStdString(), scene.toStdString())) {
      const Scene world = scenes.of(trial, {});
      opinion.trials.push_back(doctor(world, trial, bind(world, trial)));
      for (const Finding& finding : opinion.trials.back().findings)
        opinion.findings << QString::fromStdString(finding.text);
      for (const auto& said : {trial.notes, examine(trial).findings})
        for (const std::string& text : said) opinion.notes << QString::fromStdString(text);
    }
  } catch (const std::exception& error) {
    opinion.findings << QString::fromUtf8(error.what());
  }
  opinion.findings.removeDuplicates();
  opinion.notes.removeDuplicates();
  return opinion;
}

}  // namespace

const RecordingDoctor::Opinion& RecordingDoctor::of(const QString& recording, const QString& mapping,
                                                    const QString& scene, const SceneSpec& spec,
                                                    const ModelSet& models) {
  const QString key = fileState(recording) + fileState(mapping) + fileState(scene);
  const auto found = known_.constFind(key);
  return found != known_.constEnd() ? *found : *known_.insert(key, opinionOf(recording, mapping, scene, spec, models));
}

}  // namespace btr::ui
