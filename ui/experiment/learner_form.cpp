#include "ui/experiment/learner_form.h"

#include <QVBoxLayout>

namespace btr::ui {

LearnerForm::LearnerForm(const QString& what, const std::map<QString, Offers>& byGenotype, const Offers& otherwise,
                         QUndoStack& undo, QWidget* parent)
    : QWidget(parent), what_(what), byGenotype_(byGenotype), otherwise_(otherwise), undo_(undo) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  show(pageOf({}));
}

void LearnerForm::setOffers(const std::map<QString, Offers>& byGenotype, const Offers& otherwise) {
  byGenotype_ = byGenotype;
  otherwise_ = otherwise;
  for (const auto& [genotype, page] : pages_) page->addOffers(offersFor(genotype));
}

void LearnerForm::setGenotype(const QString& name) {
  const QString known = byGenotype_.count(name) ? name : QString();
  if (known == genotype_) return;
  PluginForm* next = pageOf(known);
  PluginChoice choice = page_->choice();
  const PluginChoice own = next->choice();
  const auto declares = [&](const QString& genotype, const std::string& setting) {
    for (const PluginForm::Offer& offer : offersFor(genotype))
      if (offer.name.toStdString() == choice.name) return btr::find(offer.settings, setting) != nullptr;
    return true;
  };
  std::erase_if(choice.settings, [&](const auto& setting) { return !declares(known, setting.first); });
  // What only the next page has stays as it was typed there.
  if (own.name == choice.name)
    for (const auto& [setting, value] : own.settings)
      if (!declares(genotype_, setting)) choice.settings[setting] = value;
  next->setChoice(choice);
  genotype_ = known;
  show(next);
}

void LearnerForm::setReadOnly(bool readOnly) {
  readOnly_ = readOnly;
  for (const auto& [genotype, page] : pages_) page->setReadOnly(readOnly);
}

const LearnerForm::Offers& LearnerForm::offersFor(const QString& genotype) const {
  const auto found = byGenotype_.find(genotype);
  return found == byGenotype_.end() ? otherwise_ : found->second;
}

// Pages stay for good: undo steps point into them.
PluginForm* LearnerForm::pageOf(const QString& genotype) {
  PluginForm*& page = pages_[genotype];
  if (page) return page;
  page = new PluginForm(what_, offersFor(genotype), undo_, this);
  page->setReadOnly(readOnly_);
  page->hide();
  layout()->addWidget(page);
  connect(page, &PluginForm::changed, this, [this, shown = page] {
    if (shown == page_) emit changed();
  });
  return page;
}

void LearnerForm::show(PluginForm* page) {
  if (page_) page_->hide();
  page_ = page;
  page_->show();
}

}  // namespace btr::ui
