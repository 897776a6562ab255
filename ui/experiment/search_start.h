#pragma once
#include <optional>
#include <vector>

#include "ui/experiment/plugin_form.h"

namespace btr::ui {

/// Where a search begins, as a choice of two for a PluginForm: anywhere, or around a known vector, whose settings are
/// the genotype's parameters and searchStartParameters().
std::vector<PluginForm::Offer> startOffers(const std::vector<Parameter>& genotype);

PluginChoice choiceOf(const std::optional<SearchStart>& start);
/// The way back. Throws InputError if a setting is not allowed.
std::optional<SearchStart> startFrom(const PluginChoice& choice, const std::vector<PluginForm::Offer>& offers);

}  // namespace btr::ui
