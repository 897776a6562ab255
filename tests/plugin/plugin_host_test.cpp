#include "core/plugin/plugin_host.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

#include "core/plugin/plugin.h"

namespace btr {
namespace {

std::string problemOf(const PluginHost& host, const std::string& file) {
  for (const std::string& problem : host.problems())
    if (problem.find("/" + file + ".so: ") != std::string::npos) return problem;
  return "(none)";
}

TEST(PluginHost, LoadsAllModulesThatWereBuilt) {
  const PluginHost host(PLUGIN_DIR);
  EXPECT_EQ(std::vector<std::string>{}, host.problems());
  EXPECT_NO_THROW(host.controller("kick"));
  EXPECT_NO_THROW(host.learner("ga"));
  EXPECT_NO_THROW(host.fitness("kick_distance"));
  for (const char* name :
       {"coulomb_friction", "viscous_friction", "command_delay", "backlash", "payload", "ground_slope", "gravity_tilt",
        "rolling_resistance", "position_offset", "joint_spring", "force_offset"})
    EXPECT_NO_THROW(host.effect(name)) << name;
  const auto names = host.effects();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(PluginHost, NamesThePluginsThatAreThere) {
  const PluginHost host(PLUGIN_DIR);
  try {
    host.learner("gaa");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("learner: \"gaa\" is not allowed; known: "));
    EXPECT_NE(std::string::npos, std::string(error.what()).find("ga"));
  }
}

TEST(PluginHost, LeavesOutModulesOfAnotherVersionOrCompiler) {
  const PluginHost host(REFUSED_DIR);
  EXPECT_EQ(std::vector<std::string>{"same_name"}, host.effects());
  EXPECT_NE(
      std::string::npos,
      problemOf(host, "earlier_version").find("was made for plugin version " + std::to_string(pluginApiVersion - 1)));
  EXPECT_NE(std::string::npos, problemOf(host, "other_compiler").find("was made by compiler another compiler 1.0"));
}

TEST(PluginHost, KeepsTheFirstOfTwoModulesWithOneName) {
  const PluginHost host(REFUSED_DIR);
  EXPECT_EQ("(none)", problemOf(host, "same_name_a"));
  EXPECT_NE(std::string::npos, problemOf(host, "same_name_b").find("another module has the same name"));
}

TEST(PluginHost, LeavesOutAFileThatIsNoModule) {
  namespace fs = std::filesystem;
  std::string pattern = (fs::temp_directory_path() / "uchilsim-XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  fs::create_directory(folder / "learners");
  writeFile((folder / "learners" / "text.so").string(), "this is no library");
  writeFile((folder / "learners" / "readme.txt").string(), "nor is this meant as one");
  const PluginHost host(folder.string());
  fs::remove_all(folder);
  EXPECT_EQ(1u, host.problems().size());
  EXPECT_TRUE(host.learners().empty());
  EXPECT_NE("(none)", problemOf(host, "text"));
}

TEST(PluginHost, RefusesAFolderThatIsNotThere) { EXPECT_THROW(PluginHost("/nowhere/plugins"), InputError); }

TEST(PluginHost, TheEnvironmentNamesAnotherFolder) {
  ::setenv("UCHILSIM_PLUGINS", "/some/where", 1);
  EXPECT_EQ("/some/where", PluginHost::standardDirectory());
  ::unsetenv("UCHILSIM_PLUGINS");
  // The test program lies in bin, beside lib/plugins.
  EXPECT_TRUE(std::filesystem::equivalent(PLUGIN_DIR, PluginHost::standardDirectory()));
}

}  // namespace
}  // namespace btr
