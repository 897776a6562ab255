// Who may do what, and how often.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "core/remote/gate.h"
#include "core/remote/refusal.h"
#include "tests/refusal.h"
#include "tests/remote/remote_folder.h"

namespace {

using namespace btr;
using namespace btr::remote;
using btr::test::driver;
using btr::test::refusal;
using btr::test::watcher;
using testing::HasSubstr;

constexpr const char* peer = "ipv4:127.0.0.1:4000";

class Tokens : public testing::Test {
 protected:
  std::string written(const std::string& text, mode_t mode = 0600) {
    folder_.write("tokens", text);
    const std::string path = (folder_.server() / "tokens").string();
    chmod(path.c_str(), mode);
    return path;
  }
  std::string book() { return written(std::string("# who\nwatch ") + watcher + " eye\n\ndrive " + driver + "\n"); }
  static std::string said(Gate& gate, const std::string& authorization, Role needed, const std::string& from = peer) {
    try {
      gate.admit(from, authorization, needed);
    } catch (const Refusal& refusal) {
      return refusal.what();
    }
    return "admitted";
  }

  btr::test::RemoteFolder folder_;
};

TEST_F(Tokens, GiveARoleThatMayDoWhatSmallerOnesMay) {
  Gate gate({book()});
  const std::string watch = std::string("Bearer ") + watcher, drive = std::string("Bearer ") + driver;
  EXPECT_EQ("admitted", said(gate, watch, Role::watch));
  EXPECT_THAT(said(gate, watch, Role::drive), HasSubstr("needs the role drive"));
  EXPECT_EQ("admitted", said(gate, drive, Role::watch));
  EXPECT_EQ("admitted", said(gate, drive, Role::drive));
  EXPECT_THAT(said(gate, drive, Role::administrate), HasSubstr("needs the role administrate"));
  EXPECT_EQ("eye", gate.admit(peer, watch, Role::watch).who);
}

TEST_F(Tokens, ThatNobodyHasAreRefusedWhateverTheirLength) {
  Gate gate({.tokenFile = book(), .failuresPerSecond = 1000});
  const std::string nearly = std::string(driver).substr(1);
  for (const std::string& token : {std::string(), std::string("x"), nearly, std::string(driver) + "x",
                                   std::string(100000, 'x'), std::string("drive-0123456789abcdef012\0", 26)})
    EXPECT_EQ("this token is not known", said(gate, "Bearer " + token, Role::watch));
  for (const std::string& other : {std::string(), std::string(driver), "bearer " + std::string(driver)})
    EXPECT_EQ("this server wants a token", said(gate, other, Role::watch));
}

TEST_F(Tokens, ThatAreTriedAreCountedByAddressAndOwnersStillGetIn) {
  double now = 100;
  Gate gate({.tokenFile = book(), .failuresPerSecond = 5, .clock_s = [&] { return now; }});
  int refusals = 0;
  for (int i = 0; i < 1000; ++i)  // each over a connection of its own
    refusals +=
        said(gate, "Bearer guess", Role::watch, "ipv4:10.0.0.1:" + std::to_string(1000 + i)).starts_with("too many");
  EXPECT_EQ(995, refusals);
  now += 1;
  EXPECT_EQ("this token is not known", said(gate, "Bearer guess", Role::watch, "ipv4:10.0.0.1:1"));
  EXPECT_EQ("admitted", said(gate, std::string("Bearer ") + driver, Role::drive, "ipv4:10.0.0.1:2"));
}

TEST_F(Tokens, LieInAFileThatOnlyItsOwnerReads) {
  for (const mode_t mode : {0644, 0640, 0604, 0660, 0777})
    EXPECT_THAT(refusal([&] { TokenBook book(written("watch " + std::string(watcher), mode)); }),
                HasSubstr("mode 0600"));
  EXPECT_EQ("accepted", refusal([&] { TokenBook book(written("watch " + std::string(watcher), 0600)); }));
  EXPECT_EQ("accepted", refusal([&] { TokenBook book(written("watch " + std::string(watcher), 0400)); }));
  EXPECT_THAT(refusal([&] { TokenBook book(folder_.file("none")); }), HasSubstr("a file that can be read"));
  EXPECT_THAT(refusal([&] { TokenBook book(folder_.server().string()); }), HasSubstr("a regular file"));
}

TEST_F(Tokens, AreCheckedLineByLineAndNeverShown) {
  const auto said = [&](const std::string& text) { return refusal([&] { TokenBook book(written(text)); }); };
  EXPECT_THAT(said("watch short\n"), HasSubstr(":1: a token of less than 20 characters"));
  EXPECT_THAT(said("\nroot " + std::string(driver) + "\n"), HasSubstr(":2: a line that does not begin with watch"));
  EXPECT_THAT(said("drive " + std::string(driver) + " a b\n"), HasSubstr("more than ROLE TOKEN NAME"));
  EXPECT_THAT(said("# nobody\n"), HasSubstr("without a token"));
  EXPECT_THAT(said("watch short\n"), testing::Not(HasSubstr("short\n")));
}

TEST(Gate, WithoutTokensLetsWhoReachesItDriveAndNotAdministrate) {
  Gate gate{Gate::Options{}};
  EXPECT_EQ(Role::drive, gate.admit(peer, "", Role::drive).role);
  EXPECT_THROW(gate.admit(peer, "", Role::administrate), Refusal);
}

TEST(Gate, LetsSoManyCallsThroughOfEachClientWhateverItsPort) {
  double now = 100;
  Gate gate({.tokenFile = "", .callsPerSecond = 100, .clock_s = [&] { return now; }});
  int through = 0;
  for (int i = 0; i < 10000; ++i) {
    try {
      gate.admit("ipv4:127.0.0.1:" + std::to_string(i), "", Role::watch);
      ++through;
    } catch (const Refusal& refusal) {
      EXPECT_EQ(Code::tooMuch, refusal.code);
    }
  }
  EXPECT_EQ(100, through);
  now += 0.5;
  for (int i = 0; i < 50; ++i) EXPECT_NO_THROW(gate.admit(peer, "", Role::watch));
  EXPECT_THROW(gate.admit(peer, "", Role::watch), Refusal);
  EXPECT_NO_THROW(gate.admit("ipv4:127.0.0.2:1", "", Role::watch));
}

TEST(Bucket, FillsAgainWithTime) {
  Bucket bucket(2);
  EXPECT_TRUE(bucket.take(100));
  EXPECT_TRUE(bucket.take(100));
  EXPECT_FALSE(bucket.take(100));
  EXPECT_FALSE(bucket.take(100.4));
  EXPECT_TRUE(bucket.take(100.6));
  EXPECT_FALSE(bucket.isFull(100.6));
  EXPECT_TRUE(bucket.isFull(102));
}

TEST(Loopback, ACallerIsOfThisMachineByItsAddress) {
  for (const char* peer : {"ipv4:127.0.0.1:50051", "ipv4:127.3.2.1:9", "ipv6:[::1]:50051", "ipv6:%5B::1%5D:50051",
                           "unix:/run/user/1000/uchilsim", "unix:"})
    EXPECT_TRUE(isOfThisMachine(peer)) << peer;
  for (const char* peer : {"ipv4:10.0.0.1:50051", "ipv4:127.evil.org:1", "ipv6:[2001:db8::1]:50051", "ipv6:[::11]:1",
                           "", "127.0.0.1:50051", "dns:localhost"})
    EXPECT_FALSE(isOfThisMachine(peer)) << peer;
}

TEST(Loopback, IsThisMachineAlone) {
  for (const char* own : {"127.0.0.1", "127.1.2.3", "::1", "localhost"}) EXPECT_TRUE(isLoopback(own)) << own;
  for (const char* other : {"0.0.0.0", "::", "192.168.1.2", "127.0.0.1.example.org", "127.example.org", "127.1", "",
                            "localhost.example.org"})
    EXPECT_FALSE(isLoopback(other)) << other;
}

}  // namespace
