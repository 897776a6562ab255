// A plugin that crashes in a worker process is named where the failure is recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "core/plugin/plugin_host.h"
#include "core/sim/worker_pool.h"

namespace btr {
namespace {

class PluginCrash : public ::testing::Test {
 protected:
  std::string failureOf(double how) {
    const PluginHost host(CRASHING_DIR);
    const auto fitness = host.fitness("crashing");
    WorkerPool pool(1, [&](const std::string&) {
      return std::to_string(fitness->evaluate(TrialResult{}, {{"how", how}}, {}));
    });
    const std::atomic<bool> stop{false};
    return pool.run({"job"}, stop).front().failure;
  }
};

TEST_F(PluginCrash, AWrongAddressNamesThePlugin) {
  EXPECT_EQ("the fitness plugin \"crashing\" crashed (signal 11)", failureOf(0));
}

TEST_F(PluginCrash, AnAbortNamesThePlugin) {
  EXPECT_EQ("the fitness plugin \"crashing\" crashed (signal 6)", failureOf(1));
}

TEST_F(PluginCrash, AnEndlessRecursionNamesThePlugin) {
  EXPECT_EQ("the fitness plugin \"crashing\" crashed (signal 11)", failureOf(2));
}

TEST_F(PluginCrash, AWorkerThatDiesElsewhereNamesNone) {
  WorkerPool pool(1, [](const std::string&) -> std::string { std::abort(); });
  const std::atomic<bool> stop{false};
  EXPECT_EQ("the worker died (signal 6)", pool.run({"job"}, stop).front().failure);
}

}  // namespace
}  // namespace btr
