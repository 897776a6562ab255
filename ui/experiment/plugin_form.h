#pragma once
#include <QWidget>
#include <vector>

#include "core/spec/experiment_spec.h"

class QComboBox;
class QLineEdit;
class QUndoStack;

namespace btr::ui {
class ParameterForm;

/// A plugin by name and its settings: a list of names and, for the chosen one, the form of its parameters. Settings of
/// the other plugins stay as they were typed while the form lives.
class PluginForm : public QWidget {
  Q_OBJECT
 public:
  struct Offer {
    QString name;
    std::vector<Parameter> settings;
    QString hint;                      ///< one sentence for people, may be empty
    std::vector<std::string> paths{};  ///< settings that are paths, see Controller::paths()
  };
  /// A choice whose words are choices of numbers alone.
  static PluginChoice withoutPaths(PluginChoice choice, const Offer& offer);

  PluginForm(const QString& what, const std::vector<Offer>& offers, QUndoStack& undo, QWidget* parent = nullptr);

  /// Plugins that were loaded since; those that are there stay as they are.
  void addOffers(const std::vector<Offer>& offers);

  /// A name that is not offered is shown as missing and makes the form invalid. Not an undo step. Throws InputError,
  /// with nothing changed, if a setting is not allowed.
  void setChoice(const PluginChoice& choice);
  PluginChoice choice() const;
  bool isValid() const;
  QStringList problems() const;
  void setReadOnly(bool readOnly);
  void resetAll();
  int changedCount() const;
  ParameterForm* numbers() const;  ///< of the chosen plugin, or nullptr

 signals:
  void changed();

 private:
  void add(const Offer& offer);
  QLineEdit* addPath(QWidget* page, const Offer& offer, const std::string& name);
  QLineEdit* pathEdit(int offer, const std::string& name) const;
  void select(int index);
  int offerCount() const { return int(offers_.size()); }

  QString what_;
  std::vector<Offer> offers_;
  PluginChoice missing_;  ///< the choice that is not installed, if that is selected
  int chosen_ = 0;
  QUndoStack& undo_;
  QComboBox* names_;
  std::vector<QWidget*> pages_;
};

}  // namespace btr::ui
