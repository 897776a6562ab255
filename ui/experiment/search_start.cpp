#include "ui/experiment/search_start.h"

namespace btr::ui {
namespace {

const char* const anywhere = "anywhere";
const char* const aroundVector = "around a known vector";

}  // namespace

std::vector<PluginForm::Offer> startOffers(const std::vector<Parameter>& genotype) {
  std::vector<Parameter> settings = genotype;
  settings.insert(settings.end(), searchStartParameters().begin(), searchStartParameters().end());
  return {{anywhere, {}, QObject::tr("The learner draws its first population, or begins in the middle.")},
          {aroundVector, settings,
           QObject::tr("The first population is made of permutations of this vector; a learner with a centre begins "
                       "at it.")}};
}

PluginChoice choiceOf(const std::optional<SearchStart>& start) {
  if (!start) return {anywhere, {}, {}};
  PluginChoice choice{aroundVector, start->parameters, {}};
  choice.settings["share"] = start->share;
  choice.settings["flip"] = start->flip;
  return choice;
}

std::optional<SearchStart> startFrom(const PluginChoice& choice, const std::vector<PluginForm::Offer>& offers) {
  if (choice.name != aroundVector) return {};
  SearchStart start;
  start.parameters = settingsOf(choice, offers.back().settings, "start");
  if (auto share = start.parameters.extract("share")) start.share = share.mapped();
  if (auto flip = start.parameters.extract("flip")) start.flip = flip.mapped();
  return start;
}

}  // namespace btr::ui
