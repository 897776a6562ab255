#include "core/plugin/plugin_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

#include "core/plugin/plugin.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

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
  EXPECT_EQ((std::vector<std::string>{"same_name", "says_who"}), host.effects());
  EXPECT_NE(
      std::string::npos,
      problemOf(host, "earlier_version").find("was made for plugin version " + std::to_string(pluginApiVersion - 1)));
  EXPECT_NE(std::string::npos, problemOf(host, "other_compiler").find("was made by compiler another compiler 1.0"));
}

TEST(PluginHost, SaysWhatDiffersInAModuleOfOtherFlagsLibraryAlignmentOrHeaders) {
  const PluginHost host(REFUSED_DIR);
  EXPECT_THAT(problemOf(host, "inexact"),
              HasSubstr("computes with inexact (-ffast-math) arithmetic, this program with exact: the same trial"));
  EXPECT_THAT(problemOf(host, "wide_alignment"),
              ContainsRegex("was made with Eigen .* 32 bytes, this program with .* 16"));
  EXPECT_THAT(problemOf(host, "debug_containers"), HasSubstr("debug containers (-D_GLIBCXX_DEBUG), this program with"));
  EXPECT_THAT(problemOf(host, "old_strings"), ContainsRegex("CXX11_ABI=0, this program with .*CXX11_ABI=1"));
  EXPECT_THAT(problemOf(host, "other_headers"), HasSubstr("was made with other headers than this program"));
}

TEST(PluginHost, AModuleThatSwitchesDenormalNumbersOffLeavesThemOn) {
  const PluginHost host(REFUSED_DIR);
  volatile double smallest = std::numeric_limits<double>::min();
  EXPECT_GT(smallest / 4, 0);
}

TEST(PluginHost, TellsWhoMadeAPlugin) {
  const PluginHost host(REFUSED_DIR);
  const std::vector<PluginInfo> all = host.plugins();
  const auto found = std::find_if(all.begin(), all.end(), [](const PluginInfo& p) { return p.name == "says_who"; });
  ASSERT_NE(all.end(), found);
  EXPECT_EQ("effect", found->kind);
  EXPECT_EQ("1.2", found->version);
  EXPECT_EQ("J. Doe, Zürich", found->author);
  EXPECT_EQ("MIT", found->licence);
  EXPECT_EQ(std::string(REFUSED_DIR) + "/effects/says_who.so", found->path);
}

TEST(PluginHost, KeepsTheFirstOfTwoModulesWithOneNameAndNamesBoth) {
  const PluginHost host(REFUSED_DIR);
  EXPECT_EQ("(none)", problemOf(host, "same_name_a"));
  EXPECT_THAT(problemOf(host, "same_name_b"), HasSubstr("another effect plugin has the same name \"same_name\": " +
                                                        std::string(REFUSED_DIR) + "/effects/same_name_a.so"));
}

TEST(PluginHost, LoadsAFileOnceThoughTwoFoldersLeadToIt) {
  const PluginHost host(std::vector<std::string>{PLUGIN_DIR, std::string(PLUGIN_DIR) + "/../plugins"});
  EXPECT_EQ(std::vector<std::string>{}, host.problems());
}

TEST(PluginHost, AFurtherFolderIsLoadedOnDemandOrRefusedByName) {
  const PluginHost host(PLUGIN_DIR);
  EXPECT_NO_THROW(host.load({PLUGIN_DIR}, "here"));
  const auto refusal = [&](const std::string& folder) {
    try {
      host.load({folder}, "kick.json /plugins");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("(none)");
  };
  EXPECT_THAT(refusal("/nowhere/plugins"), HasSubstr("kick.json /plugins: /nowhere/plugins is not allowed"));
  EXPECT_THAT(refusal(REFUSED_DIR), HasSubstr(std::string("kick.json /plugins: ") + REFUSED_DIR + "/effects/"));
  EXPECT_NO_THROW(host.effect("says_who"));
}

TEST(PluginHost, LeavesOutAFileThatIsNoModule) {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::create_directory(folder / "learners");
  writeFile((folder / "learners" / "text.so").string(), "this is no library");
  writeFile((folder / "learners" / "readme.txt").string(), "nor is this meant as one");
  const PluginHost host(folder.string());
  EXPECT_EQ(1u, host.problems().size());
  EXPECT_TRUE(host.learners().empty());
  EXPECT_NE("(none)", problemOf(host, "text"));
}

TEST(PluginHost, RefusesAFolderThatIsNotThere) { EXPECT_THROW(PluginHost("/nowhere/plugins"), InputError); }

TEST(PluginHost, LooksBesideTheProgramThenWhereTheEnvironmentSaysThenInTheUsersData) {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& data = temporary.path();
  fs::create_directories(data / "uchilsim" / "plugins");
  ::setenv("UCHILSIM_PLUGINS", "/some/where::/else", 1);
  ::setenv("XDG_DATA_HOME", data.c_str(), 1);
  const std::vector<std::string> path = PluginHost::searchPath();
  ::unsetenv("UCHILSIM_PLUGINS");
  ::unsetenv("XDG_DATA_HOME");
  ASSERT_EQ(4u, path.size());
  // The test program lies in bin, beside lib/plugins.
  EXPECT_TRUE(fs::equivalent(PLUGIN_DIR, path[0]));
  EXPECT_EQ("/some/where", path[1]);
  EXPECT_EQ("/else", path[2]);
  EXPECT_EQ((data / "uchilsim" / "plugins").string(), path[3]);
}

TEST(PluginHost, AFolderOfTheSearchPathThatIsNotThereIsNamed) {
  const PluginHost host(std::vector<std::string>{PLUGIN_DIR, "/nowhere/plugins"});
  EXPECT_EQ(std::vector<std::string>{"/nowhere/plugins: there is no such folder of plugins"}, host.problems());
}

}  // namespace
}  // namespace btr
