#pragma once
#include <QUndoStack>
#include <QVariantMap>
#include <QWidget>
#include <functional>
#include <map>
#include <set>

#include "core/plugin/plugin_host.h"
#include "core/spec/experiment_spec.h"
#include "ui/experiment/plugin_form.h"
#include "ui/experiment/reality_form.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QVBoxLayout;

namespace btr::ui {
class LearnerForm;
class ParameterForm;
class Section;

/// What the plugins offer to an experiment, as plain values.
struct ExperimentOffers {
  std::vector<PluginForm::Offer> controllers, fitnesses, learners;
  std::map<QString, std::vector<PluginForm::Offer>> learnersOf = {};  ///< with what a controller's genotype adds
  std::vector<PluginForm::Offer> adapters = {};                       ///< learners for the simulator's parameters
  std::map<QString, std::vector<PluginForm::Offer>> startsOf = {};    ///< where a controller's search begins
  std::vector<RealityForm::Offer> realities = {};  ///< who may measure, besides the two that always can
  /// Of a controller whose parameters stand in files: what they are for these full paths. Throws InputError.
  std::function<std::vector<Parameter>(const std::string& controller, const std::map<std::string, std::string>& paths)>
      genotypeOf = {};
  std::function<std::vector<PluginForm::Offer>(const std::vector<Parameter>& genotype)> learnersFor = {};
};
/// The host must outlive them.
ExperimentOffers offersOf(const PluginHost& host);

/// A whole ExperimentSpec as a form with folding sections and undo: spec in, spec out, nothing lost on the way.
class ExperimentForm : public QWidget {
  Q_OBJECT
 public:
  explicit ExperimentForm(const ExperimentOffers& offers, QWidget* parent = nullptr);
  ~ExperimentForm() override;

  /// The same with plugins that were loaded since. To be followed by setSpec().
  void setOffers(const ExperimentOffers& offers);
  /// Shows the spec; undo starts afresh. Throws InputError, with nothing changed, if a plugin's setting is not allowed.
  void setSpec(const ExperimentSpec& spec);
  ExperimentSpec spec() const;
  /// The numbers that spec() leaves out because they are not allowed, as they were typed: for showRefused(), after the
  /// setSpec() of a next start.
  QVariantMap refused() const;
  void showRefused(const QVariantMap& texts);
  bool isValid() const { return problems().isEmpty(); }
  QStringList problems() const;
  /// True since the last setSpec() or markSaved() if the user changed something.
  bool isModified() const { return !undo_.isClean(); }
  void markSaved() { undo_.setClean(); }
  /// For a stored run, whose spec never changes: `why` stands above the form.
  void setReadOnly(const QString& why);
  /// The simulator parameters that mean something for a stored run's robots; of a scene file the form finds them
  /// itself.
  void setMeaningful(const std::vector<Parameter>& parameters);
  QUndoStack& undoStack() { return undo_; }
  void resetAll();
  /// The keyboard begins here: the name, selected.
  void focusFirst();
  /// Another scene, as one step that can be undone.
  void chooseScene(const QString& file);

 signals:
  void changed();
  void saveRequested();
  void openRequested();
  void startRequested();
  void copyRequested();  ///< of a read-only form: begin a new experiment from it

 private:
  /// All that are shown, by name.
  std::map<QString, ParameterForm*> numbers() const;
  void offerRealities();
  QWidget* makeGeneral();
  QWidget* makeReality();
  QWidget* makeRealityLearning();
  /// Learners' pages follow the controller: its parameters may have settings of their own.
  void followController();
  /// Under which name the offers for a controller's parameters are: its own, or, where they stand in files, one for
  /// each that was read. Where they cannot be read, what `spec` begins around is taken for them.
  QString genotypeFor(const PluginChoice& controller, const ExperimentSpec& spec);
  /// Shows the simulator parameters that mean something in the scene, when that is another one.
  void followScene();
  /// The shown ones that L3 may change.
  std::set<std::string> adapted() const;
  QWidget* makeRecordings();
  void makeBars(QVBoxLayout& column);
  Section* add(QVBoxLayout& column, const QString& title, QWidget* content, bool open);
  QLineEdit* addText(QVBoxLayout& column, const QString& name, const QString& label, const QString& toolTip,
                     QWidget* beside = nullptr);
  bool isOffered(const QString& reality) const;
  void browseScene();
  void fill(const ExperimentSpec& spec);
  void update();

  ExperimentOffers offers_;
  QUndoStack undo_;
  ExperimentSpec shown_;  ///< keeps what the form has no field for: added effects, the folder, how "all" was written
  bool readOnly_ = false;
  bool filling_ = false;  ///< a specification is being put in: it is judged once, at the end
  int chosenReality_ = 0;
  QLineEdit *name_ = nullptr, *scene_ = nullptr;
  QPushButton* browse_ = nullptr;
  QComboBox* reality_ = nullptr;
  RealityForm* realityForm_ = nullptr;
  QLabel *standInNote_ = nullptr, *problem_ = nullptr, *why_ = nullptr, *effects_ = nullptr;
  QPushButton *start_ = nullptr, *save_ = nullptr, *copy_ = nullptr;
  QWidget *editBar_ = nullptr, *inside_ = nullptr;
  QString sceneRead_;            ///< the scene file whose parameters are shown, with its time
  QString followed_, genotype_;  ///< the controller that the learners' pages belong to, and its parameters
  PluginForm *controller_, *fitness_, *adaptation_;
  LearnerForm *learner_, *realityLearner_, *searchStart_;
  ParameterForm *seed_ = nullptr, *stages_, *realitySettings_, *adaptationSettings_, *simulator_, *standIn_ = nullptr,
                *recordings_ = nullptr;
  QLabel *concealed_ = nullptr, *recorded_ = nullptr;
  Section* recordingsSection_ = nullptr;
  std::vector<Section*> sections_;
};

}  // namespace btr::ui
