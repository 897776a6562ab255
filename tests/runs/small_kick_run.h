#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/run/loop/back_to_reality.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "tests/temporary_folder.h"

namespace btr::test {

/// A run of the kick in a database of its own, of two stages of one generation each, after which a person measures.
struct SmallKickRun {
  /// `settle` may change the experiment's document before the run begins.
  SmallKickRun(int population, int measured, const std::function<void(nlohmann::json&)>& settle = {}, int jobs = 1)
      : jobs_(jobs), host_(PLUGIN_DIR), database_(Database::open(folder_.file("a.db"), Database::Mode::create)) {
    const std::string examples = SOURCE_DIR "/resources/experiments";
    nlohmann::json text = nlohmann::json::parse(readFile(examples + "/kick-short.json"));
    text["learner"]["settings"]["population"] = population;
    text["stages"] = {{"first_generations", 1},
                      {"next_generations", 1},
                      {"total_generations", 2},
                      {"measured_individuals", measured}};
    text["reality"] = "person";
    if (settle) settle(text);
    run_ = startRun(database_, host_, experimentFromJson(text.dump(), "kick", examples), 7);
  }

  RunEnd goOn(Database& database) const {
    RunOptions options;
    options.jobs = jobs_;
    return continueRun(database, host_, run_, StopFlag{false}, options);
  }
  RunEnd goOn() { return goOn(database_); }

  int jobs_ = 1;
  TemporaryFolder folder_;
  PluginHost host_;
  Database database_;
  Id run_ = 0;
};

}  // namespace btr::test
