#include "ui/experiment/reality_form.h"
#include "ui/common/undoable_line.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QUndoStack>
#include <QVBoxLayout>

#include "ui/experiment/parameter_form.h"

namespace btr::ui {

RealityForm::RealityForm(const std::vector<Offer>& offers, QUndoStack& undo, QWidget* parent)
    : QWidget(parent), undo_(undo) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  addOffers(offers);
}

void RealityForm::addOffers(const std::vector<Offer>& offers) {
  for (const Offer& offer : offers) {
    if ((offer.settings.empty() && offer.texts.empty()) || page(offer.name)) continue;
    Page made{offer, new QWidget(this), {}, nullptr};
    auto* rows = new QVBoxLayout(made.widget);
    rows->setContentsMargins(0, 0, 0, 0);
    for (const TextSetting& setting : offer.texts) made.texts.push_back(addText(made, setting));
    made.numbers = new ParameterForm(offer.settings, undo_, made.widget);
    connect(made.numbers, &ParameterForm::changed, this, &RealityForm::changed);
    rows->addWidget(made.numbers);
    made.widget->hide();
    layout()->addWidget(made.widget);
    pages_.push_back(std::move(made));
  }
}

QLineEdit* RealityForm::addText(Page& page, const TextSetting& setting) {
  const QString label = QString::fromStdString(setting.name);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 2, 8, 2);
  auto* caption = new QLabel(label, page.widget);
  auto* edit = new QLineEdit(page.widget);
  caption->setBuddy(edit);
  edit->setObjectName(page.offer.name + "." + label);
  edit->setAccessibleName(label);
  edit->setToolTip(QString::fromStdString(setting.meaning) +
                   (setting.kind == TextSetting::Kind::text ? QString() : tr(" (relative to the experiment's file)")));
  row->addWidget(caption);
  row->addWidget(edit, 1);
  static_cast<QVBoxLayout*>(page.widget->layout())->addLayout(row);

  makeUndoable(*edit, undo_, tr("change %1").arg(label), [this] { emit changed(); });
  return edit;
}

const RealityForm::Page* RealityForm::page(const QString& name) const {
  for (const Page& page : pages_)
    if (page.offer.name == name) return &page;
  return nullptr;
}

void RealityForm::show(const QString& name) {
  for (const Page& page : pages_) page.widget->setVisible(page.offer.name == name);
  setVisible(this->page(name) != nullptr);
}

void RealityForm::setOptions(const QString& name, const RealityOptions& options) {
  const Page* shown = page(name);
  if (!shown) return;
  PluginChoice numbers{name.toStdString(), options.settings, options.words};
  std::vector<QString> texts;
  for (const TextSetting& setting : shown->offer.texts) {
    const auto given = numbers.words.find(setting.name);
    texts.push_back(given == numbers.words.end() ? QString() : QString::fromStdString(given->second));
    numbers.words.erase(setting.name);
  }
  const Values values = settingsOf(numbers, shown->offer.settings, "reality/settings");
  for (std::size_t i = 0; i < texts.size(); ++i) shown->texts[i]->setText(texts[i]);
  shown->numbers->setValues(values);
}

RealityOptions RealityForm::options(const QString& name) const {
  const Page* shown = page(name);
  if (!shown) return {};
  PluginChoice choice = choiceOf(name.toStdString(), shown->numbers->values(), shown->offer.settings);
  for (std::size_t i = 0; i < shown->texts.size(); ++i)
    if (const QString text = shown->texts[i]->text().trimmed(); !text.isEmpty())
      choice.words[shown->offer.texts[i].name] = text.toStdString();
  return {std::move(choice.settings), std::move(choice.words)};
}

QStringList RealityForm::problems(const QString& name) const {
  const Page* shown = page(name);
  if (!shown) return {};
  QStringList problems;
  for (std::size_t i = 0; i < shown->texts.size(); ++i)
    if (shown->offer.texts[i].required && shown->texts[i]->text().trimmed().isEmpty())
      problems << tr("Measured by %1: %2 is missing (%3)")
                      .arg(name, QString::fromStdString(shown->offer.texts[i].name),
                           QString::fromStdString(shown->offer.texts[i].meaning));
  return problems + shown->numbers->problems();
}

ParameterForm* RealityForm::numbers(const QString& name) const {
  const Page* shown = page(name);
  return shown ? shown->numbers : nullptr;
}

void RealityForm::setReadOnly(bool readOnly) {
  for (const Page& page : pages_) {
    for (QLineEdit* edit : page.texts) edit->setReadOnly(readOnly);
    page.numbers->setReadOnly(readOnly);
  }
}

}  // namespace btr::ui
