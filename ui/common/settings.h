#pragma once
#include <QByteArray>
#include <QSettings>
#include <QString>
#include <QStringList>
#include <QVariantMap>
#include <map>
#include <set>

#include "ui/common/look/theme.h"

namespace btr::ui {

/// What the window remembers between two starts. Each setter stores at once; nothing here belongs to an experiment.
class Settings {
 public:
  /// `file` names an INI file; empty means the user's own settings.
  explicit Settings(const QString& file = {});

  QByteArray geometry() const;
  QByteArray layout() const;  ///< of docks and toolbars, empty if none fits `layoutVersion`
  void setWindow(const QByteArray& geometry, const QByteArray& layout);

  Look look() const;
  void setLook(Look look);

  /// Databases opened last, the latest first, at most eight, only those that still exist.
  QStringList recentDatabases() const;
  void addRecentDatabase(const QString& path);

  /// The run that was selected last in this database, 0 if none.
  qint64 selectedRun(const QString& database) const;
  void setSelectedRun(const QString& database, qint64 run);

  /// Names that the user gave to experiments of this database; a stored experiment itself never changes.
  std::map<qint64, QString> experimentNames(const QString& database) const;
  void setExperimentName(const QString& database, qint64 experiment, const QString& name);  ///< empty: its own again
  /// Experiments of this database that the tree puts away.
  std::set<qint64> archived(const QString& database) const;
  void setArchived(const QString& database, const std::set<qint64>& experiments);

  /// The experiment in the form that was not started yet, and the folder that its paths start from.
  QString draft() const;
  QString draftFolder() const;
  void setDraft(const QString& json, const QString& folder);
  QVariantMap draftRefused() const;  ///< numbers of it that are not allowed, see ExperimentForm::refused()
  void setDraftRefused(const QVariantMap& texts);

  /// Measurements of a run that were entered and not saved yet, as text; empty if there are none.
  QString measurementDraft(const QString& database, qint64 run) const;
  void setMeasurementDraft(const QString& database, qint64 run, const QString& draft);

  /// The game, scene or robot that was opened last in the Scene page; empty if there is none.
  QString lastGame() const;
  void setLastGame(const QString& file);

  int jobs() const;  ///< worker processes of a run, 0: as many as processors
  void setJobs(int jobs);

  bool flag(const QString& name, bool byDefault) const;
  void setFlag(const QString& name, bool value);

  /// Raised when the docks change so much that a stored layout no longer fits.
  static constexpr int layoutVersion = 2;

 private:
  mutable QSettings store_;
};

}  // namespace btr::ui
