#include "ui/live/drawn/lamp_places.h"

#include <array>
#include <cmath>

namespace btr::ui {
namespace {

using Eigen::Vector3d;

const QColor white(255, 255, 245), red(255, 50, 40), green(60, 255, 90), blue(70, 120, 255), amber(255, 170, 40);
const Vector3d up(0, 0, 1);

/// The head of our ERS-7 across its length: middle height, half width, half height [mm].
struct Section {
  double x, z, width, height;
};
constexpr std::array<Section, 4> head{{{22, 7, 44, 35}, {42, 2, 38, 30}, {60, -4, 30, 23}, {76, -9, 23, 17}}};

Section sectionAt(double x) {
  std::size_t i = 1;
  while (i + 1 < head.size() && head[i].x < x) ++i;
  const Section &a = head[i - 1], &b = head[i];
  const double part = (x - a.x) / (b.x - a.x);
  const auto between = [part](double from, double to) { return from + part * (to - from); };
  return {x, between(a.z, b.z), between(a.width, b.width), between(a.height, b.height)};
}

/// A place of the face: across from the picture's left and down, each 0 … 1.
LampSpot onFace(const std::string& lamp, double across, double down, QColor a, QColor b) {
  constexpr double back = 26, front = 75, wide = 58 * M_PI / 180, above = 1.5, mm = 1e-3;
  const Section at = sectionAt(back + down * (front - back));
  const double angle = (2 * across - 1) * wide;  // from straight up, to the robot's left
  const Vector3d spot(at.x, at.width * std::sin(angle), at.z + at.height * std::cos(angle));
  const Vector3d outward = Vector3d(0.7, std::sin(angle), std::cos(angle)).normalized();
  return {lamp, "HEAD", mm * (spot + above * outward), outward, a, b};
}

std::vector<LampSpot> ers7() {
  std::vector<LampSpot> spots;
  const QColor none;
  const auto face = [&](int number, double across, double down, QColor a, QColor b) {
    spots.push_back(onFace("face_" + std::to_string(number), across, down, a, b));
  };
  const auto pair = [&](int left, double across, double down, QColor a, QColor b) {
    face(left, across, down, a, b);
    face(left + 1, 1 - across, down, a, b);
  };
  const auto both = [&](int number, double across, double down, QColor a, QColor b) {
    face(number, across, down, a, b);
    face(number, 1 - across, down, a, b);
  };
  pair(1, .1, .85, white, green);
  pair(3, .1, .67, white, none);
  pair(3, .28, .93, none, green);
  face(5, .3, .65, white, green);
  face(6, .7, .65, white, white);
  pair(7, .1, .47, white, white);
  pair(9, .31, .46, white, white);
  face(11, .5, .49, white, white);
  face(12, .5, .64, white, white);
  both(13, .31, .46, red, none);
  both(13, .28, .93, none, blue);
  both(14, .1, .31, red, none);
  both(14, .1, .98, none, blue);
  const auto top = [&](const char* lamp, double x, double y, double z, QColor colour) {
    spots.push_back({lamp, "HEAD", {x, y, z}, up, colour, colour});
  };
  top("head_colour", 0.004, 0.006, 0.047, amber);
  top("head_white", 0.004, -0.006, 0.047, white);
  top("mode_red", -0.024, 0.012, 0.042, red);
  top("mode_green", -0.024, 0, 0.043, green);
  top("mode_blue", -0.024, -0.012, 0.042, blue);
  top("wireless", -0.032, 0, 0.038, blue);
  const auto back = [&](const std::string& where, double x, QColor colour) {
    spots.push_back({"back_" + where + "_colour", "BODY", {x, 0.012, 0.062}, up, colour, colour});
    spots.push_back({"back_" + where + "_white", "BODY", {x, -0.012, 0.062}, up, white, white});
  };
  back("front", 0.045, blue);
  back("middle", 0, amber);
  back("rear", -0.045, red);
  return spots;
}

std::vector<LampSpot> ers210() {
  std::vector<LampSpot> spots;
  const auto eye = [&](const std::string& side, double way) {
    const Vector3d outward = Vector3d(1, 0.3 * way, 0.4).normalized();
    spots.push_back({"eye_" + side + "_lower", "HEAD", {0.056, 0.018 * way, 0.016}, outward, red, red});
    spots.push_back({"eye_" + side + "_middle", "HEAD", {0.052, 0.022 * way, 0.024}, outward, green, green});
    spots.push_back({"eye_" + side + "_upper", "HEAD", {0.046, 0.024 * way, 0.032}, outward, red, red});
  };
  eye("left", 1);
  eye("right", -1);
  spots.push_back({"mode", "HEAD", {-0.01, 0, 0.05}, up, green, green});
  spots.push_back({"tail_blue", "TAIL", {-0.03, 0.004, 0.02}, up, blue, blue});
  spots.push_back({"tail_orange", "TAIL", {-0.03, -0.004, 0.02}, up, amber, amber});
  return spots;
}

}  // namespace

const std::vector<LampSpot>& lampSpots(const std::string& model) {
  static const std::vector<LampSpot> of7 = ers7(), of210 = ers210(), none;
  return model == "ERS-7" ? of7 : model == "ERS-210" ? of210 : none;
}

QColor shining(const LampSpot& spot, const Orders& orders) {
  const auto lamp = orders.lamps.find(spot.lamp);
  if (lamp == orders.lamps.end() || lamp->second.brightness <= 0) return {};
  QColor colour = lamp->second.mode == "B" ? spot.colourB : spot.colour;
  if (colour.isValid()) colour.setAlphaF(static_cast<float>(lamp->second.brightness));
  return colour;
}

}  // namespace btr::ui
