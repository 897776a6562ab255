// Datagrams to everybody: robots of a game, and programs of this computer.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A program's process, frame by frame beside others, and what it says.
struct RobotOfMany {
  explicit RobotOfMany(const std::string& stick) : process(optionsFor(stick)) {}
  static RobotProcess::Options optionsFor(const std::string& stick) {
    RobotProcess::Options options;
    options.stick = stick;
    options.design = "ERS-7";
    return options;
  }
  void step() {
    const OrderFrame orders = process.exchange(robot.sense());
    robot.obey(orders);
    for (const ConsoleLine& line : orders.lines) said += line.text + "\n";
  }
  TrivialRobot robot{robotDesign("ERS-7")};
  RobotProcess process;
  std::string said;
};

std::string numberedCrier(int number) {
  const std::string made = stickOf("crier"), stick = emptyFolder("crier" + std::to_string(number));
  std::filesystem::copy(made, stick, std::filesystem::copy_options::recursive);
  writeText(stick + "/NUMBER.TXT", std::to_string(number) + "\n");
  return stick;
}

/// A socket of this computer's that hears what robots tell everybody at `port`, and tells them.
class Bystander {
 public:
  explicit Bystander(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    const int yes = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    setsockopt(socket_, SOL_SOCKET, SO_BROADCAST, &yes, sizeof(yes));
    everybody_.sin_family = AF_INET;
    everybody_.sin_port = htons(port);
    inet_pton(AF_INET, "127.255.255.255", &everybody_.sin_addr);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&everybody_), sizeof(everybody_)), 0);
  }
  ~Bystander() { close(socket_); }
  void tell(const std::string& text) const {
    sendto(socket_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&everybody_), sizeof(everybody_));
  }
  std::string heard() const {
    std::string all;
    char text[64];
    for (ssize_t size = 0; (size = recv(socket_, text, sizeof(text), 0)) > 0;)
      all += std::string(text, static_cast<std::size_t>(size)) + "\n";
    return all;
  }

 private:
  int socket_;
  sockaddr_in everybody_{};
};

TEST(Net, WhatIsSentToEverybodyReachesOtherRobotsAndThisComputerButNotItsSender) {
  constexpr std::uint16_t port = 21733;
  const Bystander bystander(port);
  RobotOfMany first(numberedCrier(1)), second(numberedCrier(2));
  for (int frame = 0; frame < 20; ++frame) {
    first.step();
    second.step();
  }
  const std::string heard = bystander.heard();
  for (const char* word : {"word 0", "word 1", "word 2"}) {
    EXPECT_THAT(first.said, HasSubstr(std::string("1 hears robot 2, ") + word + "\n"));
    EXPECT_THAT(second.said, HasSubstr(std::string("2 hears robot 1, ") + word + "\n"));
    EXPECT_THAT(heard, HasSubstr(std::string("robot 1, ") + word + "\n"));
    EXPECT_THAT(heard, HasSubstr(std::string("robot 2, ") + word + "\n"));
  }
  EXPECT_THAT(first.said, Not(HasSubstr("hears robot 1")));
  bystander.tell("the game begins");
  first.step();
  second.step();
  EXPECT_THAT(first.said, HasSubstr("1 hears the game begins\n"));
  EXPECT_THAT(second.said, HasSubstr("2 hears the game begins\n"));
  // The second finds the port taken, and both say where theirs is, once, though they bind it twice.
  EXPECT_THAT(second.said, HasSubstr(", as 21733 is in use\n"));
  const std::string where = "UDP port 21733 of the robot is 127.0.0.1:21733\n";
  EXPECT_THAT(first.said, HasSubstr(where));
  EXPECT_EQ(first.said.find(where, first.said.find(where) + 1), std::string::npos);
}

}  // namespace
}  // namespace btr::openr
