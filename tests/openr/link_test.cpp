// Frames and orders as bytes: back again as they were, and anything else refused.
#include <gtest/gtest.h>

#include <random>

#include "core/openr/robot_link.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

SensorFrame someFrame() {
  SensorFrame frame;
  frame.number = 0x0ffffff0;
  frame.time_us = 1234567890123;
  frame.joints = {{-1000000, 5, -1023}, {7, -8, 9}};
  frame.sensors = {-9806650, 0, 2147483647};
  frame.power = {42, 2999, 7000, -1200, 2, true};
  frame.image = CameraImage{2, 1, {1, 2, 3, 4, 5, 6}};
  frame.typed = "yes\n";
  frame.shutdown = true;
  return frame;
}

OrderFrame someOrders() {
  OrderFrame orders;
  orders.joints.resize(3);
  orders.joints[0].target_urad = -5;
  orders.joints[1].gain = JointGain{1, 2, 3, 4, 5, 65535};
  orders.joints[2].gainEnabled = false;
  orders.lamps = {{7, 200, 1}, {65535, 0, 0xffff}};
  orders.motorPower = true;
  orders.camera.shutter = 3;
  orders.lines = {{"One", "text"}, {"", ""}};
  orders.ended = Ended{Ended::Why::endlessLoop, "One", "Ready", "for ever"};
  return orders;
}

TEST(RobotLink, AFrameComesBackAsItWas) {
  const auto bytes = bytesOf(someFrame());
  const SensorFrame back = sensorFrameFrom(bytes.data(), bytes.size());
  EXPECT_EQ(bytesOf(back), bytes);
  EXPECT_EQ(back.joints.at(0).duty, -1023);
  EXPECT_EQ(back.sensors.at(0), -9806650);
  EXPECT_EQ(back.image->rows, someFrame().image->rows);
  EXPECT_EQ(back.typed, "yes\n");
  EXPECT_TRUE(back.power.pausePressed);
}

TEST(RobotLink, OrdersComeBackAsTheyWere) {
  const auto bytes = bytesOf(someOrders());
  const OrderFrame back = orderFrameFrom(bytes.data(), bytes.size());
  EXPECT_EQ(bytesOf(back), bytes);
  EXPECT_EQ(back.joints.at(0).target_urad, -5);
  EXPECT_EQ(back.joints.at(1).gain->dShift, 65535);
  EXPECT_EQ(back.joints.at(2).gainEnabled, false);
  EXPECT_FALSE(back.camera.gain.has_value());
  EXPECT_EQ(back.ended->method, "Ready");
}

TEST(RobotLink, EveryShorterMessageIsRefused) {
  const auto frame = bytesOf(someFrame()), orders = bytesOf(someOrders());
  for (std::size_t size = 0; size < frame.size(); ++size)
    EXPECT_THROW(sensorFrameFrom(frame.data(), size), InputError) << size;
  for (std::size_t size = 0; size < orders.size(); ++size)
    EXPECT_THROW(orderFrameFrom(orders.data(), size), InputError) << size;
}

TEST(RobotLink, MoreBytesAndOtherMessagesAreRefused) {
  auto frame = bytesOf(someFrame()), orders = bytesOf(someOrders());
  EXPECT_THROW(orderFrameFrom(frame.data(), frame.size()), InputError);
  EXPECT_THROW(sensorFrameFrom(orders.data(), orders.size()), InputError);
  frame.push_back(0);
  orders.push_back(0);
  EXPECT_THROW(sensorFrameFrom(frame.data(), frame.size()), InputError);
  EXPECT_THROW(orderFrameFrom(orders.data(), orders.size()), InputError);
}

TEST(RobotLink, DamagedBytesAreRefusedOrAreAMessage) {
  std::mt19937 random(1);
  for (int round = 0; round < 20000; ++round) {
    auto bytes = round % 2 == 0 ? bytesOf(someFrame()) : bytesOf(someOrders());
    for (int i = 0; i < 3; ++i) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    try {
      if (round % 2 == 0)
        EXPECT_LE(sensorFrameFrom(bytes.data(), bytes.size()).joints.size(), bytes.size());
      else
        EXPECT_LE(orderFrameFrom(bytes.data(), bytes.size()).joints.size(), bytes.size());
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace btr::openr
