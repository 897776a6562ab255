#pragma once
#include <QMap>
#include <QStringList>

#include "core/gap/recordings/doctor/doctor.h"
#include "core/sim/scene.h"

namespace btr::ui {

/// What the doctor says of a recording before anything is simulated. Asked again and again while a form is filled in:
/// an answer is kept until scene, recording or mapping change.
class RecordingDoctor {
 public:
  struct Opinion {
    QStringList findings;           ///< what its columns say of the file; why it cannot be read, if it cannot
    QStringList notes;              ///< what reading it changed, its pauses and counts
    std::vector<Diagnosis> trials;  ///< what the file is divided into
  };
  /// `mapping`: a path, "" for none. Large files are left to the analysis itself.
  const Opinion& of(const QString& recording, const QString& mapping, const QString& scene, const SceneSpec& spec,
                    const ModelSet& models);

 private:
  QMap<QString, Opinion> known_;
};

}  // namespace btr::ui
