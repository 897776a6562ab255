#include "core/cluster/build_identity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/cluster/parts.h"
#include "tests/refusal.h"

namespace {

using btr::difference;
using btr::Parts;

TEST(BuildIdentity, NamesProgramLibrariesAndPlugins) {
  const btr::PluginHost host(PLUGIN_DIR);
  const Parts identity = btr::buildIdentity(host);
  const auto has = [&](const std::string& beginning) {
    return std::ranges::any_of(identity, [&](const std::string& entry) { return entry.starts_with(beginning); });
  };
  EXPECT_TRUE(has("program btr "));
  EXPECT_TRUE(has("library libbtr_core.so "));
  EXPECT_TRUE(has("library libm.so"));
  EXPECT_TRUE(has("plugin controllers/kick"));
  EXPECT_TRUE(has("processor's fused arithmetic "));
  EXPECT_EQ(std::nullopt, difference(identity, btr::buildIdentity(host)));
}

TEST(BuildIdentity, SaysWhatDiffers) {
  const Parts ours{"library libode.so 1", "plugin fitness/a.so 2"};
  EXPECT_EQ("its plugin fitness/a.so is another one",
            difference(ours, {"library libode.so 1", "plugin fitness/a.so 3"}).value_or(""));
  EXPECT_EQ("it has no plugin fitness/a.so", difference(ours, {"library libode.so 1"}).value_or(""));
  EXPECT_EQ("it has a plugin fitness/b.so that is not here",
            difference(ours, {"library libode.so 1", "plugin fitness/a.so 2", "plugin fitness/b.so 9"}).value_or(""));
}

TEST(Parts, ComeBackAsTheyWerePacked) {
  const Parts parts{"", "kind", std::string("\0\n", 2), std::string(100000, 'x')};
  EXPECT_EQ(parts, btr::unpack(btr::pack(parts)));
  const std::string bytes = btr::pack(parts);
  EXPECT_EQ("a message between ranks is cut short",
            btr::test::refusal([&] { btr::unpack(bytes.substr(0, bytes.size() - 1)); }));
  EXPECT_EQ("a message between ranks is cut short", btr::test::refusal([&] { btr::unpack(bytes + "\x7f"); }));
}

}  // namespace
