#pragma once
#include <QWidget>
#include <map>
#include <vector>

#include "ui/experiment/plugin_form.h"

namespace btr::ui {

/// A learner and its settings, which may depend on what is searched: a page for each genotype that was chosen so far.
/// When the genotype changes, what both pages have in common goes along.
class LearnerForm : public QWidget {
  Q_OBJECT
 public:
  using Offers = std::vector<PluginForm::Offer>;
  /// `byGenotype` has the offers for each genotype's name; `otherwise` are those for any other.
  LearnerForm(const QString& what, const std::map<QString, Offers>& byGenotype, const Offers& otherwise,
              QUndoStack& undo, QWidget* parent = nullptr);

  /// The same with plugins that were loaded since; those that are there stay as they are.
  void setOffers(const std::map<QString, Offers>& byGenotype, const Offers& otherwise);
  const Offers& offersFor(const QString& genotype) const;
  /// Not an undo step: it follows the choice of the controller, which is one.
  void setGenotype(const QString& name);
  void setChoice(const PluginChoice& choice) { page_->setChoice(choice); }
  PluginChoice choice() const { return page_->choice(); }
  QStringList problems() const { return page_->problems(); }
  void setReadOnly(bool readOnly);
  void resetAll() { page_->resetAll(); }
  int changedCount() const { return page_->changedCount(); }
  ParameterForm* numbers() const { return page_->numbers(); }

 signals:
  void changed();

 private:
  PluginForm* pageOf(const QString& genotype);
  void show(PluginForm* page);

  QString what_, genotype_;
  std::map<QString, Offers> byGenotype_;
  Offers otherwise_;
  QUndoStack& undo_;
  bool readOnly_ = false;
  std::map<QString, PluginForm*> pages_;
  PluginForm* page_ = nullptr;
};

}  // namespace btr::ui
