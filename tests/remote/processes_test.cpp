// The server's processes: what they hold, how long they are waited for, whom the end of one concerns.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/remote/desk.h"
#include "core/remote/nursery.h"
#include "core/remote/run_keeper.h"

namespace {

using namespace btr;
using namespace btr::remote;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::size_t descriptors() {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

/// A process that begins with one call and then does this with its socket.
using Then = std::function<void(int socket)>;
Nursery::Life afterACall(Then then) {
  return [then = std::move(then)](char) {
    std::string call;
    while (receiveFrame(Nursery::socketOfChild, call, -1) == Got::frame) then(Nursery::socketOfChild);
  };
}

const std::string ok(1, static_cast<char>(Code::ok));

TEST(RunKeeper, ARunThatIsOverHoldsNoDescriptors) {
  Nursery nursery(afterACall([](int socket) { sendFrame(socket, ok + "finished"); }));
  RunKeeper keeper(nursery);
  const auto work = [&](Id run) {
    keeper.begin(run, 0);
    RunNews news;
    while ((news = keeper.news(run, 10, [] { return false; })).what == RunNews::What::working) {
    }
    return news.what;
  };
  EXPECT_EQ(RunNews::What::finished, work(1));
  const std::size_t before = descriptors();
  for (Id run = 2; run <= 40; ++run) EXPECT_EQ(RunNews::What::finished, work(run));
  EXPECT_EQ(before, descriptors());
  // What became of the last ones is still known, of those long ago the database tells.
  EXPECT_EQ(RunNews::What::finished, keeper.news(40, 0, [] { return false; }).what);
  EXPECT_EQ(RunNews::What::notHere, keeper.news(1, 0, [] { return false; }).what);
}

TEST(RunKeeper, ARunWhoseProcessDiesSaysSoAndHoldsNothing) {
  Nursery nursery(afterACall([](int) { raise(SIGKILL); }));
  RunKeeper keeper(nursery);
  const std::size_t before = descriptors();
  keeper.begin(7, 0);
  RunNews news;
  while ((news = keeper.news(7, 10, [] { return false; })).what == RunNews::What::working) {
  }
  EXPECT_EQ(RunNews::What::stopped, news.what);
  EXPECT_THAT(news.message, HasSubstr("what it did is stored"));
  EXPECT_FALSE(keeper.isHere(7));
  EXPECT_EQ(before, descriptors());
}

TEST(Nursery, ThatHasEndedSaysSo) {
  const std::string self = std::to_string(getpid());
  Nursery nursery([](char) {});
  pid_t process = 0;
  std::ifstream("/proc/self/task/" + self + "/children") >> process;
  ASSERT_GT(process, 0);
  kill(process, SIGKILL);
  try {
    // It may make one more before it ends.
    for (int i = 0; i < 1000; ++i) nursery.start('x');
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_EQ(Code::unavailable, refusal.code);
    EXPECT_THAT(refusal.what(), HasSubstr("start the server again"));
  }
}

TEST(Child, SignsOfLifeAreNoAnswer) {
  Nursery nursery(afterACall([](int socket) {
    for (int i = 0; i < 1000; ++i) sendFrame(socket, "");
    sendFrame(socket, ok + "done");
  }));
  const auto child = nursery.start('x');
  const Answer answer = child->ask("call", {});
  EXPECT_EQ(Code::ok, answer.code) << answer.bytes;
  EXPECT_EQ("done", answer.bytes);
}

TEST(Child, ThatTakesNoCallIsEndedInTime) {
  // It never reads: a call that is larger than the socket's room is not taken.
  Nursery nursery([](char) { pause(); });
  const auto child = nursery.start('x');
  const Answer answer = child->ask(std::string(16u << 20, 'x'), {0.2});
  EXPECT_EQ(Code::tooLate, answer.code);
  EXPECT_FALSE(child->alive());
}

TEST(Child, ThatStopsInTheMiddleOfAnAnswerIsEndedInTime) {
  Nursery nursery(afterACall([](int socket) {
    const std::uint32_t size = 100;
    [[maybe_unused]] const ssize_t n = send(socket, &size, sizeof size, MSG_NOSIGNAL);
    pause();
  }));
  const auto child = nursery.start('x');
  EXPECT_EQ(Code::tooLate, child->ask("call", {0.2}).code);
}

TEST(Child, ACallThatWaitedForOneThatWasCancelledSaysThatItWasNotBegun) {
  Nursery nursery(afterACall([](int) { pause(); }));
  const auto child = nursery.start('x');
  std::atomic<bool> asking{false}, cancelled{false};
  std::thread first([&] {
    const Answer answer = child->ask("call", {60, [&] {
                                                asking = true;
                                                return cancelled.load();
                                              }});
    EXPECT_EQ(Code::cancelled, answer.code);
    EXPECT_TRUE(answer.begun);
  });
  while (!asking) std::this_thread::yield();
  std::thread second([&] {
    const Answer answer = child->ask("call", {60, [&] {
                                                cancelled = true;  // it waits for its turn: now the first one goes
                                                return false;
                                              }});
    EXPECT_EQ(Code::unavailable, answer.code);
    EXPECT_FALSE(answer.begun);
  });
  first.join();
  second.join();
}

/// Answers with so many bytes, or works until it is told to leave.
class TestDesk final : public Desk {
 public:
  std::string answer(Method method, std::string_view message) override {
    if (method == Method::get) return std::string(std::stoul(std::string(message)), 'x');
    while (true) betweenPieces();
  }
};

TEST(Desk, AnAnswerThatIsTooLargeSaysSoAndWhatToDo) {
  Nursery nursery([](char) {
    TestDesk desk;
    serve(desk, Nursery::socketOfChild);
  });
  const auto child = nursery.start('x');
  const auto ask = [&](std::size_t size) { return child->ask(callOf(Method::get, std::to_string(size)), {}); };
  EXPECT_EQ(largestAnswer, ask(largestAnswer).bytes.size());
  const Answer answer = ask(largestAnswer + 1);
  EXPECT_EQ(Code::tooMuch, answer.code);
  EXPECT_THAT(answer.bytes, HasSubstr("at most 64 MB is allowed: ask for less at a time"));
  EXPECT_EQ(10u, ask(10).bytes.size());  // it goes on
}

TEST(Desk, TellsThatItIsAtWorkAndLeavesWhenItIsTold) {
  Nursery nursery([](char) {
    TestDesk desk;
    serve(desk, Nursery::socketOfChild, 0, Child::isToLeave);
  });
  const auto child = nursery.start('x');
  const Answer answer = child->ask(callOf(Method::step, ""), {60, {}, true, [] { return true; }});
  EXPECT_EQ(Code::cancelled, answer.code);
  EXPECT_EQ("the server ends", answer.bytes);
  EXPECT_TRUE(child->alive());
}

TEST(Child, ThatDoesNotLeaveWhenItIsToldIsEnded) {
  Nursery nursery(afterACall([](int) {
    while (true) pause();  // a plugin that hangs, so to speak
  }));
  const auto child = nursery.start('x');
  const Answer answer = child->ask("call", {3600, {}, true, [] { return true; }});
  EXPECT_EQ(Code::cancelled, answer.code);
  EXPECT_THAT(answer.bytes, HasSubstr("did not leave"));
  EXPECT_FALSE(child->alive());
}

}  // namespace
