// btr model check, list.
#include <cstdio>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/spec/error.h"

namespace btr::cli {
namespace {

void checkModelFile(const std::string& path, const Shell& shell) {
  const RobotModel model = loadModel(path);
  if (!shell.json) {
    std::cout << describeModel(model);
    return;
  }
  nlohmann::json links = nlohmann::json::array(), joints = nlohmann::json::array(), warnings = nlohmann::json::array();
  for (const Link& l : model.links)
    links.push_back({{"name", l.name}, {"mass_kg", l.inertial.mass_kg}, {"mass_group", l.massGroup}});
  for (const Joint& j : model.joints) {
    joints.push_back({{"name", j.name},
                      {"parent", model.links[static_cast<std::size_t>(j.parentLink)].name},
                      {"lower", j.lower},
                      {"upper", j.upper}});
    if (j.mimic)
      joints.back()["mimic"] = {{"joint", model.joints[static_cast<std::size_t>(j.mimic->leader)].name},
                                {"multiplier", j.mimic->multiplier},
                                {"offset", j.mimic->offset}};
  }
  for (const Warning& w : model.warnings) warnings.push_back({{"line", w.line}, {"text", w.text}});
  const Inertial all = massProperties(model, std::vector<double>(model.joints.size(), 0.0));
  printJson({{"name", model.name},
             {"links", links},
             {"joints", joints},
             {"mass_kg", all.mass_kg},
             {"centre_of_mass_m", {all.centreOfMass_m.x(), all.centreOfMass_m.y(), all.centreOfMass_m.z()}},
             {"warnings", warnings}});
}

nlohmann::json describe(const std::vector<Parameter>& parameters) {
  nlohmann::json all = nlohmann::json::array();
  for (const Parameter& p : parameters) {
    nlohmann::json one{{"name", p.name},       {"unit", p.unit},       {"meaning", p.meaning},
                       {"minimum", p.minimum}, {"maximum", p.maximum}, {"default", p.byDefault}};
    if (p.neutral) one["neutral"] = *p.neutral;
    if (!p.choices.empty()) one["choices"] = p.choices;
    all.push_back(one);
  }
  return all;
}

/// All plugins with who made them and where they lie, and what could not be loaded.
void listModules(Shell& shell) {
  const PluginHost& host = shell.plugins();
  if (shell.json) {
    nlohmann::json plugins = nlohmann::json::array(), failures = nlohmann::json::array();
    for (const PluginInfo& p : host.plugins())
      plugins.push_back({{"kind", p.kind},
                         {"name", p.name},
                         {"version", p.version},
                         {"author", p.author},
                         {"licence", p.licence},
                         {"path", p.path}});
    for (const PluginFailure& f : host.failures()) failures.push_back({{"path", f.path}, {"why", f.why}});
    printJson({{"plugins", plugins}, {"failures", failures}});
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const PluginInfo& p : host.plugins()) rows.push_back({p.kind, p.name, p.version, p.author, p.licence, p.path});
  std::cout << table({"kind", "name", "version", "author", "licence", "path"}, rows);
  for (const PluginFailure& f : host.failures())
    std::cout << "not loaded: " << printable(f.path) << ": " << printable(f.why) << '\n';
}

/// Where real fitness can come from, with settings that are numbers and those that are texts.
void listRealities(Shell& shell) {
  const PluginHost& host = shell.plugins();
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& name : host.realities()) {
    const auto reality = host.reality(name);
    nlohmann::json texts = nlohmann::json::array();
    for (const TextSetting& t : reality->texts())
      texts.push_back({{"name", t.name}, {"meaning", t.meaning}, {"required", t.required}});
    all.push_back({{"name", name},
                   {"meaning", reality->meaning()},
                   {"parameters", describe(reality->settings())},
                   {"texts", texts}});
  }
  if (shell.json) return printJson(all);
  for (const auto& one : all) {
    std::cout << one["name"].get<std::string>() << ": " << one["meaning"].get<std::string>() << '\n';
    for (const auto& t : one["texts"])
      std::cout << "  " << t["name"].get<std::string>() << ": " << t["meaning"].get<std::string>() << '\n';
    for (const auto& p : one["parameters"])
      std::cout << "  " << p["name"].get<std::string>() << ": " << p["meaning"].get<std::string>() << '\n';
  }
}

/// A noun phrase, the equation with its letters, and who says so; nothing of an effect that keeps it to itself.
std::string lawLine(const EffectLaw& law) {
  if (law.says.empty()) return "";
  std::string line = "  " + law.says;
  if (!law.equation.empty()) line += ": " + law.equation;
  if (!law.symbols.empty()) line += "  (" + law.symbols + ")";
  return line + (law.source.empty() ? "" : "  [" + law.source + "]") + '\n';
}

void listPlugins(const std::string& kind, Shell& shell) {
  if (kind == "plugins") return listModules(shell);
  const PluginHost& host = shell.plugins();
  std::vector<std::pair<std::string, std::vector<Parameter>>> found;
  if (kind == "effects")
    for (const std::string& n : host.effects()) found.emplace_back(n, host.effect(n)->parameters());
  if (kind == "learners")
    for (const std::string& n : host.learners()) found.emplace_back(n, host.learner(n)->settings());
  if (kind == "controllers")
    for (const std::string& n : host.controllers()) {
      const auto controller = host.controller(n);
      found.emplace_back(n, controller->settings());
      found.emplace_back(n + " (evolved)", controller->genotype());
    }
  if (kind == "fitness")
    for (const std::string& n : host.fitnesses()) found.emplace_back(n, host.fitness(n)->settings());
  if (kind == "realities") return listRealities(shell);
  if (shell.json) {
    nlohmann::json all = nlohmann::json::array();
    for (const auto& [name, parameters] : found) {
      all.push_back({{"name", name}, {"parameters", describe(parameters)}});
      if (kind != "effects") continue;
      const EffectLaw law = host.effect(name)->law();
      all.back()["law"] = {
          {"says", law.says}, {"equation", law.equation}, {"symbols", law.symbols}, {"source", law.source}};
    }
    printJson(all);
    return;
  }
  for (const auto& [name, parameters] : found) {
    std::cout << name << '\n';
    if (kind == "effects") std::cout << lawLine(host.effect(name)->law());
    std::vector<std::vector<std::string>> rows;
    for (const Parameter& p : parameters) {
      std::string words;
      for (const std::string& c : p.choices) words += (words.empty() ? "" : "|") + c;
      const auto show = [&](double value) {
        return p.choices.empty() ? toText(value) : p.choices[static_cast<std::size_t>(value)];
      };
      rows.push_back({"  " + p.name, p.unit, p.choices.empty() ? brief(p.minimum) + " … " + brief(p.maximum) : words,
                      show(p.byDefault), p.neutral ? toText(*p.neutral) : "", p.meaning});
    }
    if (!rows.empty()) std::cout << table({"  parameter", "unit", "allowed", "default", "neutral", "meaning"}, rows);
  }
}

}  // namespace

void addModelCommands(CLI::App& app, Shell& shell) {
  CLI::App* model = app.add_subcommand("model", "robot files");
  model->require_subcommand(1);
  auto path = std::make_shared<std::string>();
  CLI::App* check = model->add_subcommand("check", "read a .wrl or .urdf; print links, joints, masses, warnings");
  check->add_option("FILE", *path, "robot file")->required();
  check->callback([path, &shell] { checkModelFile(*path, shell); });

  auto kind = std::make_shared<std::string>();
  CLI::App* list = app.add_subcommand("list", "what plugins are there, with their parameters, units and bounds");
  list->add_option(
          "KIND", *kind,
          "effects, learners, controllers, fitness, realities, or plugins: all, with version, author, licence and path")
      ->required()
      ->check(CLI::IsMember({"effects", "learners", "controllers", "fitness", "realities", "plugins"}));
  list->callback([kind, &shell] { listPlugins(*kind, shell); });
}

}  // namespace btr::cli
