// The robot's services, each by a program of our own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/openr/sdk/OPEN_R/include/btr_openr_version.h"
#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr int framesOfVector = 16;

TEST(Names, EveryNameOfTheInterfaceIsThere) {
  const StickRun run = runStick(stickOf("names"), 3);
  EXPECT_THAT(run.all(), HasSubstr("named 1"));
  EXPECT_THAT(run.all(), HasSubstr("1570796 1500000 10"));
  EXPECT_THAT(run.all(), HasSubstr("size 1 3 10.0.1.100"));
  EXPECT_THAT(run.all(), Not(HasSubstr("not seen")));
}

class Mover : public testing::Test {
 protected:
  const StickRun run = runStick(stickOf("mover"), 100);
  const RobotDesign& design = robotDesign("ERS-7");
};

TEST_F(Mover, VectorsFollowEachOtherWithoutAGap) {
  const auto pan = run.targets(design, "HEAD_PAN");
  ASSERT_EQ(pan.size(), 5u * framesOfVector);
  for (std::size_t i = 0; i < pan.size(); ++i) EXPECT_EQ(pan[i], static_cast<std::int32_t>(i) * 1000) << i;
}

TEST_F(Mover, ReadyComesOnceForEachVectorPlayedItsReferenceGone) {
  EXPECT_THAT(run.all(), HasSubstr("ready 1 refs 1 1\n"));
  EXPECT_THAT(run.all(), HasSubstr("ready 2 refs 1 2\n"));
  EXPECT_THAT(run.all(), HasSubstr("ready 3 refs 2 1\n"));
}

TEST_F(Mover, JointsStayWithinTheirRange) {
  for (const std::int32_t mouth : run.targets(design, "MOUTH")) EXPECT_EQ(mouth, -959931);  // −55°, told −90°
  for (const std::int32_t ear : run.targets(design, "L_EAR_BASE")) EXPECT_EQ(ear, 261799);
}

TEST_F(Mover, GainsNeedToBeEnabledFirst) {
  EXPECT_THAT(run.all(), HasSubstr("gain 4108\nMover: gain 0\nMover: gains 8 2 4 14 2 15\n"));
  EXPECT_THAT(run.all(), HasSubstr("unknown 6 ffffffff\n"));
  ASSERT_FALSE(run.orders.empty());
  const OrderFrame& first = run.orders[0];
  EXPECT_EQ(first.motorPower, true);
  EXPECT_EQ(first.joints.at(1).gainEnabled, true);
  EXPECT_EQ(first.joints.at(1).gain->p, 8);
  EXPECT_EQ(first.joints.at(2).gainEnabled, false);  // not opened
}

TEST_F(Mover, KeysStartVectorsTogetherAndPeriodsLast) {
  std::size_t face = 0;
  while (design.lamps[face].name != "face_1") ++face;
  std::vector<std::pair<int, int>> shone;  // frame, intensity
  for (std::size_t i = 0; i < run.orders.size(); ++i)
    for (const LampOrder& lamp : run.orders[i].lamps)
      if (lamp.lamp == face) shone.emplace_back(static_cast<int>(i), lamp.intensity);
  EXPECT_THAT(shone, testing::ElementsAre(std::pair(16, 55), std::pair(20, 155), std::pair(24, 255)));
}

TEST(Senser, VectorsOfFourFramesAndCalls) {
  const StickRun run = runStick(stickOf("senser"), 20);
  EXPECT_THAT(run.all(), HasSubstr("ERS-7 seven common 6\n"));
  EXPECT_THAT(run.all(), HasSubstr("vector of 34, frames 4 from 1\n"));
  EXPECT_THAT(run.all(), HasSubstr("vector of 34, frames 4 from 5\n"));
  EXPECT_THAT(run.all(), HasSubstr("near 1 0 1 0\n"));  // near and far take turns
  EXPECT_THAT(run.all(), HasSubstr("up -9806650\n"));
  EXPECT_THAT(run.all(), HasSubstr("time 0 24000\n"));
  EXPECT_THAT(run.all(), HasSubstr("references 3\n"));  // the pool's, the notice's, its own
}

TEST(Senser, DesignDataAreThoseOfTheRobot) {
  EXPECT_THAT(runStick(stickOf("senser"), 3, {}, "ERS-210").all(), HasSubstr("ERS-210 twoten common"));
}

TEST(Senser, ThePauseSwitchIsToldAndShutdownEndsAll) {
  const StickRun run =
      runStick(stickOf("senser"), 100, [](int frame, TrivialRobot& robot) { robot.power.pausePressed = frame == 30; });
  EXPECT_THAT(run.all(), HasSubstr("pause 1\nSenser: capacity 100\n"));
  EXPECT_EQ(run.orders.size(), 30u);
  EXPECT_EQ(run.ended.why, Ended::Why::shutdown);
}

TEST(Looker, LayersBandsAndColours) {
  // Grey, lighter to the right by 2 a pixel of layer H; a red patch (Cr 210, Cb 130) of 40 × 32 pixels of layer H.
  CameraImage image{416, 320, std::vector<std::uint8_t>(std::size_t{3} * 416 * 320)};
  for (std::size_t y = 0; y < 320; ++y)
    for (std::size_t x = 0; x < 416; ++x) {
      const bool red = x >= 40 && x < 120 && y >= 20 && y < 84;
      image.rows[y * 3 * 416 + x] = static_cast<std::uint8_t>(20 + x / 2 + y % 2 * 8);
      image.rows[y * 3 * 416 + 416 + x] = red ? 210 : 128;
      image.rows[y * 3 * 416 + 832 + x] = red ? 130 : 128;
    }
  const StickRun run = runStick(stickOf("looker"), 12, [&](int, TrivialRobot& robot) { robot.image = image; });
  // Layer H at (4, 5): x = 8, 9; rows 10, 11: (24 + 24 + 32 + 32) / 4 = 28, LH (32 + 32 − 24 − 24) / 4 + 128 = 132.
  EXPECT_THAT(run.all(), HasSubstr("layer 0: 208 x 160 skip 1040 valid 1 0, y 28 cr 128 cb 128 lh 132\n"));
  EXPECT_THAT(run.all(), HasSubstr("layer 1: 104 x 80 skip 520 valid 1 0, y 33"));
  EXPECT_THAT(run.all(), HasSubstr("layer 2: 52 x 40 "));
  EXPECT_THAT(run.all(), HasSubstr("cdt 104 x 80, 1 0, frequency 20 0, field 1\n"));  // 20 · 16 pixels of M / 16
  EXPECT_THAT(run.all(), HasSubstr("shutter 0 4\n"));
  EXPECT_EQ(run.orders[0].camera.shutter, 3u);
}

TEST(Sounder, WhatIsPlayedStandsInAWavFile) {
  const std::string stick = stickOf("sounder");
  const StickRun run = runStick(stick, 100);
  EXPECT_THAT(run.all(), HasSubstr("ready at start 1\n"));
  EXPECT_THAT(run.all(), HasSubstr("mic 16000 Hz 16 bits channels 2 bytes 1024\n"));
  EXPECT_THAT(run.all(), HasSubstr(stick + "/SPEAKER.WAV"));
  std::ifstream in(stick + "/SPEAKER.WAV", std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  ASSERT_EQ(bytes.size(), 44 + 10u * 512 * 2);  // 10 blocks of 32 ms at 16 kHz, 16 bits
  // 100 · 256 at −10 dB.
  const auto first =
      static_cast<std::int16_t>(static_cast<std::uint8_t>(bytes[44]) | static_cast<std::uint8_t>(bytes[45]) << 8);
  EXPECT_NEAR(first, 25600 * 0.31623, 2);
}

TEST(Sounder, TheLoudspeakerOfTheErs210SitsInItsHead) {
  const std::string stick = stickOf("sounder");
  EXPECT_THAT(runStick(stick, 100, {}, "ERS-210").all(), HasSubstr(stick + "/SPEAKER.WAV"));
}

TEST(Filer, FilesConsoleAndTime) {
  const std::string stick = stickOf("filer"), outside = emptyFolder("outside");
  writeText(outside + "/secret.txt", "s");
  std::filesystem::create_directory_symlink(outside, stick + "/LINK");
  const StickRun run = runStick(stick, 400, [](int frame, TrivialRobot& robot) {
    if (frame == 11) robot.typed = "Rex\n42 dog\n";
  });
  const std::string all = run.all();
  EXPECT_THAT(all, HasSubstr("Filer: constructed\n"));
  EXPECT_THAT(all, HasSubstr("C++ reads first line\n"));
  EXPECT_THAT(all, HasSubstr("mkdir 0 rename 0\n"));
  EXPECT_THAT(all, HasSubstr("stat 0 11\n"));
  EXPECT_THAT(all, HasSubstr("entry NEW.TXT\n"));
  for (const char* path : {"/etc/passwd", "/MS/../secret.txt", "/MS/SUB/../../secret.txt", "secret.txt",
                           "/MS/LINK/secret.txt", "/MSX/a", "/MS/LINK"})
    EXPECT_THAT(all, HasSubstr(std::string(path) + " not there, written 0, opened 0, removed 0, folder 0\n"));
  EXPECT_THAT(all, HasSubstr("programs -1 1\n"));
  EXPECT_TRUE(std::filesystem::exists(outside + "/secret.txt"));
  // It waits for the console; the other object does not.
  EXPECT_LT(all.find("tick 2"), all.find("hello Rex"));
  EXPECT_THAT(all, HasSubstr("42 dog\n"));
  EXPECT_THAT(all, HasSubstr("slept 2\n"));
  EXPECT_THAT(all, HasSubstr("partly\n"));
  EXPECT_THAT(all, Not(HasSubstr("never")));
}

// Time passes between frames alone, so what waits for it in a loop would wait without end.
TEST(Idler, WhoLooksAtTheClockUntilItIsLateEnoughWaits) {
  const std::string all = runStick(stickOf("idler"), 300).all();
  EXPECT_THAT(all, HasSubstr("measured 0 ms\n"));
  EXPECT_THAT(all, HasSubstr("second 2 of its clock: 0 ms\n"));
  EXPECT_THAT(all, HasSubstr("50 ms by the system's time: 56\n"));  // seven frames of 8 ms
  EXPECT_THAT(all, HasSubstr("20 ms of day: 80\n"));                // and three
  EXPECT_THAT(all, HasSubstr("10 ms of work: 96\n"));               // and two
}

TEST(Net, TcpAndUdpBetweenTwoObjects) {
  const std::string all = runStick(stickOf("net"), 50).all();
  EXPECT_THAT(all, HasSubstr("TCP port 54321 of the robot is 127.0.0.1:"));
  EXPECT_THAT(all, HasSubstr("connected 1 to 10.0.1.100\n"));
  EXPECT_THAT(all, HasSubstr("beyond 1, nowhere 1, unmapped 1\n"));
  EXPECT_THAT(all, HasSubstr("a program sends or receives in memory of its own;"));
  EXPECT_THAT(all, HasSubstr("server: 9 bytes\n"));
  EXPECT_THAT(all, HasSubstr("client: over TCP, 9 bytes\n"));
  EXPECT_THAT(all, HasSubstr("nobody 1\n"));
  EXPECT_THAT(all, HasSubstr("server: closed 1\n"));
  EXPECT_THAT(all, HasSubstr("client: over UDP from port 54322\n"));
}

TEST(Net, ClosingEndsAListenAndABoundPortIsKept) {
  const std::string all = runStick(stickOf("closer"), 20).all();
  EXPECT_THAT(all, HasSubstr("bind 0\n"));
  EXPECT_THAT(all, HasSubstr("listen 2 port 45678\n"));  // closed while it waited
  EXPECT_THAT(all, HasSubstr("connected 0\n"));
  EXPECT_THAT(all, HasSubstr("listen 0 port 45678\n"));
}

// Robots of a game are switched on together: one may ask before the other listens.
TEST(Net, WhoConnectsAtTheStartWaitsForWhoListensAMomentLater) {
  const std::string all = runStick(stickOf("late"), 20).all();
  EXPECT_THAT(all, HasSubstr("Late: listens\n"));
  EXPECT_THAT(all, HasSubstr("somebody came 0\n"));
  EXPECT_THAT(all, HasSubstr("connected 0\n"));
}

TEST(Net, WhoConnectedIsToldBeforeWhatWasSentAfterwards) {
  EXPECT_THAT(runStick(stickOf("passive"), 20).all(),
              HasSubstr("data connection 0\nPassive: order 0: LIST\nPassive: sent 0\n"));
}

StickRun faulty(const std::string& what) {
  return runStick(
      stickOf("faulty"), 60,
      [&](int frame, TrivialRobot& robot) {
        if (frame == 5) robot.typed = what + "\n";
      },
      "ERS-7", 1);
}

TEST(Faults, ACrashNamesObjectAndMethod) {
  const std::pair<const char*, const char*> faults[] = {{"null", "wrote at address 0"},
                                                        {"read", "read at address 0x10"},
                                                        {"divide", "divided"},
                                                        {"nan", "no number"},
                                                        {"overflow", "too large"},
                                                        {"misaligned", "Faulty.cc:"},
                                                        {"misaligned", "int' at address 0x"},
                                                        {"half a double", "no multiple of 8"},
                                                        {"by zero", "divided"},
                                                        {"smash", "address"},
                                                        {"deep", "stack is full"},
                                                        {"throw", "exception"},
                                                        {"literal", "is to be read only"},
                                                        {"mips", "this processor does not have"}};
  for (const auto& [what, expected] : faults) {
    const StickRun run = faulty(what);
    EXPECT_EQ(run.ended.why, Ended::Why::crash) << what;
    EXPECT_EQ(run.ended.object, "Faulty") << what;
    EXPECT_EQ(run.ended.method, "Notify") << what;
    EXPECT_THAT(run.ended.what, HasSubstr(expected)) << what;
    EXPECT_THAT(run.all(), HasSubstr(std::string("does ") + what)) << what;  // what it said before is not lost
  }
}

TEST(Faults, DamagedMemoryNamesObjectAndMethod) {
  for (const char* what : {"heap", "twice", "gone", "pop"}) {
    const StickRun run = faulty(what);
    EXPECT_EQ(run.ended.why, Ended::Why::crash) << what;
    EXPECT_EQ(run.ended.object, "Faulty") << what << " " << run.ended.what;
    EXPECT_EQ(run.ended.method, "Notify") << what;
    EXPECT_THAT(run.ended.what, AnyOf(HasSubstr("memory damaged"), HasSubstr("address"))) << what;
  }
}

TEST(Faults, AnEndlessLoopNamesObjectAndMethod) {
  const StickRun run = faulty("loop");
  EXPECT_EQ(run.ended.why, Ended::Why::endlessLoop);
  EXPECT_EQ(run.ended.object, "Faulty");
  EXPECT_EQ(run.ended.method, "Notify");
}

TEST(Faults, AbortAndAFailedAssertionEndTheMethodOnly) {
  for (const char* what : {"abort", "assert"}) {
    const StickRun run = faulty(what);
    EXPECT_EQ(run.ended.why, Ended::Why::shutdown) << what;
    EXPECT_THAT(run.all(), Not(HasSubstr("lives on"))) << what;
  }
}

TEST(Faults, WhatTheOldCompilerLetPassRuns) {
  EXPECT_THAT(faulty("forget").all(), HasSubstr("lives on"));
  EXPECT_THAT(faulty("pool").all(), HasSubstr("pool 3 1\nFaulty: lives on"));
  EXPECT_THAT(faulty("delete").all(), HasSubstr("delete 1\nFaulty: delete 0\nFaulty: lives on"));
}

TEST(Faults, WritingToARegionThatIsToBeReadOnlyEndsTheProgram) {
  const StickRun run = faulty("read only");
  EXPECT_THAT(run.all(), HasSubstr("region 1\n"));
  EXPECT_EQ(run.ended.why, Ended::Why::crash);
  EXPECT_THAT(run.all(), Not(HasSubstr("lives on")));
}

TEST(Process, EvenWithoutTheCLibraryNothingOutsideTheStickIsWritten) {
  constexpr long versionOnly = 1;
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, versionOnly) < 1) GTEST_SKIP() << "this kernel has no Landlock";
  const std::string stick = stickOf("faulty"), outside = emptyFolder("escape") + "/file";
  writeText(stick + "/ESCAPE.TXT", outside);
  const StickRun run = runStick(stick, 30, [](int frame, TrivialRobot& robot) {
    if (frame == 5) robot.typed = "escape\n";
  });
  EXPECT_THAT(run.all(), HasSubstr("outside 0 program 0\n"));
  EXPECT_FALSE(std::filesystem::exists(outside));
}

TEST(Process, AStickWithoutAListIsRefused) {
  RobotProcess::Options options;
  options.stick = emptyFolder("no_list");
  EXPECT_ANY_THROW(RobotProcess{options});
}

TEST(Process, WhatIsNoModuleIsLeftOut) {
  const std::string stick = stickOf("names");
  std::ofstream(stick + "/OPEN-R/MW/CONF/OBJECT.CFG", std::ios::app) << "/MS/OPEN-R/MW/OBJS/MIPS.BIN\n/MS/ABSENT.BIN\n";
  writeText(stick + "/OPEN-R/MW/OBJS/MIPS.BIN", "this is no module");
  const StickRun run = runStick(stick, 3);
  EXPECT_THAT(run.all(),
              HasSubstr("MIPS.BIN is no module that `btr openr build` has made for this computer (file too short): "));
  EXPECT_THAT(run.all(), HasSubstr("/MS/ABSENT.BIN is not on the stick"));
  EXPECT_THAT(run.all(), HasSubstr("named 1"));
}

TEST(Process, AStickOfWhichNoObjectStartsIsRefused) {
  const std::string stick = stickOf("names"), list = stick + "/OPEN-R/MW/CONF/OBJECT.CFG";
  writeText(list, "/MS/OPEN-R/MW/OBJS/MIPS.BIN\n/MS/ABSENT.BIN\n");
  writeText(stick + "/OPEN-R/MW/OBJS/MIPS.BIN", "this is no module");
  StickRun run = runStick(stick, 3);
  EXPECT_EQ(run.ended.why, Ended::Why::refused);
  EXPECT_THAT(run.ended.what,
              testing::StartsWith("no object could be started: /MS/OPEN-R/MW/OBJS/MIPS.BIN is no module"));
  EXPECT_THAT(run.ended.what, testing::EndsWith("; /MS/ABSENT.BIN is not on the stick"));
  EXPECT_EQ(run.orders.size(), 1u);
  writeText(list, "[ERS-210]\n/MS/OPEN-R/MW/OBJS/MIPS.BIN\n");
  EXPECT_EQ(runStick(stick, 3).ended.what, "OBJECT.CFG lists no object for the ERS-7");
}

TEST(Process, AWrongConnectionSaysWhatThereIs) {
  const std::string stick = stickOf("senser");
  std::ofstream(stick + "/OPEN-R/MW/CONF/CONNECT.CFG", std::ios::app)
      << "OVirtualRobotComm.Sensr.OSensorFrameVectorData.S Senser.Sensors.OSensorFrameVectorData.O\n"
         "A.Eye.OFbkImageVectorData.O OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S\n";
  const std::string all = runStick(stick, 3).all();
  EXPECT_THAT(all,
              HasSubstr("nobody here has OVirtualRobotComm.Sensr.OSensorFrameVectorData.S: not connected; there is "
                        "OVirtualRobotComm.Sensor.OSensorFrameVectorData.S, "));
  EXPECT_THAT(all,
              HasSubstr("the subject OVirtualRobotComm.FbkImageSensor.OFbkImageVectorData.S is to stand before the "
                        "observer A.Eye.OFbkImageVectorData.O"));
}

TEST(Process, ThatVanishesIsNamed) {
  const StickRun run = faulty("vanish");
  EXPECT_EQ(run.ended.why, Ended::Why::crash);
  EXPECT_THAT(run.ended.what, HasSubstr("ended by a signal: Killed"));
}

TEST(Process, KilledFromOutsideItSaysSo) {
  RobotProcess::Options options;
  options.stick = stickOf("names");
  RobotProcess program(options);
  TrivialRobot robot(robotDesign("ERS-7"));
  EXPECT_FALSE(program.exchange(robot.sense()).ended);
  program.kill();
  EXPECT_TRUE(program.exchange(robot.sense()).ended);
}

/// A robot's program that is this shell script; 3 is its link.
RobotProcess::Options script(const std::string& name, const std::string& text) {
  RobotProcess::Options options;
  options.stick = stickOf("names");
  options.program = emptyFolder(name) + "/program";
  writeText(options.program, "#!/bin/sh\n" + text + "\n");
  std::filesystem::permissions(options.program, std::filesystem::perms::owner_all);
  return options;
}

TEST(Process, IsWaitedForAsLongAsItMayTakeWhateverItHasDone) {
  SensorFrame large;
  large.image = CameraImage{1000, 1000, std::vector<std::uint8_t>(3000000)};
  // It takes nothing; it begins an answer of 100 bytes.
  for (const char* text : {"exec sleep 1000", "printf '\\144\\000\\000\\000' >&3; exec sleep 1000"}) {
    RobotProcess program(script("late", text));
    const OrderFrame orders = program.exchange(large, 0.2);
    ASSERT_TRUE(orders.ended);
    EXPECT_EQ(Ended::Why::endlessLoop, orders.ended->why);
  }
}

TEST(Process, ThatHangsUpAndLivesOnIsEnded) {
  RobotProcess program(script("hangs_up", "exec 3>&-; exec sleep 1000"));
  const OrderFrame orders = program.exchange(SensorFrame());
  ASSERT_TRUE(orders.ended);
  EXPECT_THAT(orders.ended->what, HasSubstr("closed the link"));
}

TEST(Process, EndsWithItsSimulatorEvenWhileItWaitsForSomethingElse) {
  int line[2];
  ASSERT_EQ(0, pipe(line));
  const std::string stick = stickOf("faulty");
  const pid_t simulator = fork();
  if (simulator == 0) {
    RobotProcess::Options options;
    options.stick = stick;
    RobotProcess program(options);
    TrivialRobot robot(robotDesign("ERS-7"));
    for (int frame = 1; frame < 10; ++frame) {
      if (frame == 5) {
        const pid_t self = getpid();
        pid_t robotProcess = 0;
        std::ifstream("/proc/" + std::to_string(self) + "/task/" + std::to_string(self) + "/children") >> robotProcess;
        [[maybe_unused]] const ssize_t n = write(line[1], &robotProcess, sizeof robotProcess);
        robot.typed = "sleep\n";
      }
      robot.obey(program.exchange(robot.sense()));
    }
    _exit(1);  // not reached: it sleeps
  }
  pid_t robotProcess = 0;
  ASSERT_EQ(static_cast<ssize_t>(sizeof robotProcess), read(line[0], &robotProcess, sizeof robotProcess));
  const int watched = static_cast<int>(syscall(SYS_pidfd_open, robotProcess, 0));
  ASSERT_GE(watched, 0);
  // Asleep in the call that it never comes back from.
  const std::string file = "/proc/" + std::to_string(robotProcess) + "/syscall";
  for (std::string number; number != std::to_string(SYS_pause);)
    if (!(std::ifstream(file) >> number)) break;
  kill(simulator, SIGKILL);
  waitpid(simulator, nullptr, 0);
  pollfd one{watched, POLLIN, 0};
  constexpr int patience_ms = 30000;
  EXPECT_EQ(1, poll(&one, 1, patience_ms));
  kill(robotProcess, SIGKILL);
  close(watched);
  close(line[0]);
  close(line[1]);
}

TEST(Process, AModuleOfOlderHeadersIsRefusedBeforeItRuns) {
  const std::string stick = stickOf("names"), folder = stick + "/OPEN-R/MW/OBJS/";
  const std::string packed = std::filesystem::directory_iterator(folder)->path().string(), plain = folder + "PLAIN";
  ASSERT_EQ(0, std::system(("gzip -dc '" + packed + "' > '" + plain + "'").c_str()));
  std::ifstream in(plain, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string mark = BTR_OPENR_MARK;
  const auto run = [&](const std::string& version) {
    std::string other = bytes;
    for (std::size_t at = 0; (at = other.find(mark, at)) != std::string::npos; ++at)
      other.replace(at + mark.size(), version.size(), version);
    std::ofstream(packed, std::ios::binary) << other;
    return runStick(stick, 3);
  };
  EXPECT_THAT(run(BTR_OPENR_VERSION).all(), HasSubstr("named 1"));
  for (const std::string version : {"0", "1", "2", "3", "9"}) {
    if (version == BTR_OPENR_VERSION) continue;
    const StickRun refused = run(version);
    EXPECT_EQ(Ended::Why::refused, refused.ended.why);
    EXPECT_THAT(refused.ended.what, HasSubstr("build the stick again with btr openr build"));
    EXPECT_TRUE(refused.lines.empty()) << refused.all();
  }
  // One from before there were versions.
  const StickRun refused = run("x");
  EXPECT_EQ(Ended::Why::refused, refused.ended.why);
}

/// From now on the kernel says of this process and its children that it has no Landlock.
void withoutLandlock() {
  sock_filter rules[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_landlock_create_ruleset, 0, 1),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{std::size(rules), rules};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    _exit(2);
}

TEST(Process, SaysWhereTheKernelDoesNotKeepItOnItsStick) {
  const std::string stick = stickOf("names");
  EXPECT_THAT(runStick(stick, 3).all(), Not(HasSubstr("Landlock")));
  const pid_t child = fork();
  if (child == 0) {
    withoutLandlock();
    const std::string said = runStick(stick, 3).all();
    _exit(said.find("this kernel does not keep programs on their stick") != std::string::npos &&
                  said.find("named 1") != std::string::npos
              ? 0
              : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(0, WEXITSTATUS(status));
}

}  // namespace
}  // namespace btr::openr
