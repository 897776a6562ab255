#pragma once
#include <QObject>
#include <vector>

#include "core/run/reality/rig.h"
#include "core/spec/scene_spec.h"
#include "ui/controllers/workbench.h"

namespace btr::ui {
class ExperimentTree;
class GapPage;
class SimulatorsPage;

/// Who takes what gap analysis found: the selected run, or a rig, a scene that no run belongs to, with simulator
/// versions and recordings of its own.
class RigController : public QObject {
  Q_OBJECT
 public:
  RigController(Workbench& bench, GapPage& page, ExperimentTree& tree, SimulatorsPage& shown);
  void select(Id rig, Id simulator);

 private:
  /// A scene that a page of gap analysis names, as the database knows it.
  struct KnownRig {
    QString file, name;  ///< empty: none
    Rig rig;
    std::vector<SimulatorRecord> versions;
  };
  void readRig(KnownRig& rig, const QString& file);
  void findVersions(KnownRig& rig);
  void showRigs();
  void takeRigs(const std::vector<SimulatorRecord>& versions);
  std::vector<SimulatorRecord> versionsOf(Id rig) const;
  void showAdoption();
  QString ownerOfRecordings() const;  ///< the rig's scene; empty: the selected run's experiment
  bool hasOwner() const;
  void refuse(const QString& why);
  static QString needsRecordings();
  static QString needsOwner();
  void keepRecordings(const QStringList& files, const QString& scene);
  void takeStoredRecordings();
  void exportRecordings(const std::vector<RecordingRecord>& recordings, const QString& folder);

  Workbench& bench_;
  GapPage& page_;
  ExperimentTree& tree_;
  SimulatorsPage& shown_;
  SceneSpec runScene_;
  std::vector<SimulatorRecord> simulators_, rigVersions_;
  KnownRig setupRig_, reportRig_;
  QString refused_;          ///< why recordings could not be kept or taken
  bool rigChanged_ = false;  ///< by us: it is to be said when the new version is seen
  Id shownRig_ = 0;          ///< whose versions the page of simulators shows in place of a run's
};

}  // namespace btr::ui
