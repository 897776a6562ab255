#pragma once
#include <QObject>

#include "ui/controllers/workbench.h"

namespace btr::ui {
class ExperimentForm;

/// The experiment that is being described: from files, into files, kept between two starts, started as a run.
class DraftController : public QObject {
  Q_OBJECT
 public:
  /// `spec` shows the settings of a stored run, which can be copied.
  DraftController(Workbench& bench, ExperimentForm& draft, ExperimentForm& spec);

  /// These replace what is in the form, after a question if it was not saved. False, the form unchanged, if the user
  /// declined or (with a message) if the file is wrong.
  bool begin();
  bool open(const QString& file);
  bool copyStored();
  void openWithDialog();
  bool save();  ///< False if the user gave no name or, with a message, if it cannot be written.
  void start();
  /// The form holds something that is in no file and no database.
  bool isUnsaved() const;

  /// For the next start, with numbers that are not allowed as they were typed. What cannot be read again is asked
  /// about: false if the user stays.
  bool keep();
  void restore();  ///< the draft of last time; on the first start an example

 private:
  bool mayReplace();
  bool mayForget(const QString& why);
  void offerPluginsOf(const ExperimentSpec& spec);
  void show(const ExperimentSpec& spec);
  bool fresh();

  Workbench& bench_;
  ExperimentForm &draft_, &spec_;
  QString refused_, refusedFile_;  ///< why the form could not be started, and a file not be opened
  bool keptUnsaved_ = false;       ///< restored from the last start, where it was not saved
};

}  // namespace btr::ui
