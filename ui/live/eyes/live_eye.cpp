#include "ui/live/eyes/live_eye.h"

#include <algorithm>
#include <cmath>

#include "core/spec/error.h"

namespace btr::ui {
namespace {

std::size_t robotOf(const LiveScene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.objects().size(); ++i)
    if (scene.objects()[i].name == name && scene.objects()[i].kind == LiveObject::Kind::robot) return i;
  std::string known;
  for (const LiveObject& object : scene.objects())
    if (object.kind == LiveObject::Kind::robot) known += (known.empty() ? "" : ", ") + object.name;
  throw InputError("camera", "robot \"" + name + "\"", known.empty() ? "a game with a robot" : "one of " + known);
}

std::size_t linkOf(const RobotModel& model, const CameraSpec& camera) {
  const int link = model.findLink(camera.mount.link);
  if (link >= 0) return static_cast<std::size_t>(link);
  std::string known;
  for (const Link& each : model.links) known += (known.empty() ? "" : ", ") + each.name;
  throw InputError("camera \"" + camera.name + "\"", "mount link \"" + camera.mount.link + "\"",
                   "a link of " + model.name + ": " + known);
}

Eigen::Isometry3d poseOf(const CameraMount& mount) {
  const auto& p = mount.position_m;
  const auto& q = mount.orientation_wxyz;
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

}  // namespace

LiveEye::LiveEye(const Game& game, const ModelSet& models, const std::vector<std::string>& channels,
                 const std::string& robot, CameraSpec camera, GlContextFactory factory)
    : scene_(game, models, channels),
      robot_(robotOf(scene_, robot)),
      link_(linkOf(*scene_.models()[robot_], camera)),
      pipeline_(std::move(camera)),
      moments_s_(pipeline_.moments_s()),
      seen_(pipeline_.rows()),
      mount_(poseOf(pipeline_.spec().mount)),
      renderer_(std::move(factory)) {
  builder_.setGround(game.scene.floor ? Ground::plain : Ground::none);
  builder_.setCarpet(scene_.carpet());
  builder_.setLevels(true);
  builder_.setFurtherRobots(scene_.models());
  builder_.setFurtherJackets(scene_.jackets());
  builder_.setBalls(scene_.radii());
  builder_.hideLink(std::pair{robot_, link_});
  objects_.assign(1 + scene_.objects().size(), "");
  objects_[SceneBuilder::groundNumber() - 1] = "floor";
  std::size_t further = 0, ball = 0;
  for (const LiveObject& object : scene_.objects())
    objects_[object.kind == LiveObject::Kind::ball ? builder_.ballNumber(ball++) - 1u
                                                   : builder_.furtherNumber(further++) - 1u] = object.name;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].starts_with(robot + ".") &&
        (channels[i].ends_with(".position_rad") || channels[i].ends_with(".position_m"))) {
      joints_.push_back(static_cast<int>(i));
      jointColumns_.push_back(channels[i]);
    }
}

void LiveEye::setCamera(CameraSpec camera) {
  const std::size_t link = linkOf(*scene_.models()[robot_], camera);
  CameraPipeline pipeline(std::move(camera));
  link_ = link;
  pipeline_ = std::move(pipeline);
  moments_s_ = pipeline_.moments_s();
  seen_ = pipeline_.rows();
  mount_ = poseOf(pipeline_.spec().mount);
  builder_.hideLink(std::pair{robot_, link_});
  if (rows_.empty()) return;
  rows_.erase(rows_.begin(), rows_.end() - 1);
  next_ = firstFrame(rows_.back());
}

std::uint64_t LiveEye::firstFrame(const LiveRow& row) const {
  return static_cast<std::uint64_t>(std::ceil(scene_.time_s(row) * camera().frameRate_hz - 1e-9));
}

void LiveEye::add(const LiveRow& row) {
  if (!rows_.empty() && scene_.time_s(row) <= scene_.time_s(rows_.back())) {
    if (scene_.time_s(row) == scene_.time_s(rows_.back())) {
      rows_.back() = row;  // a hand moved something while the world waited
      return;
    }
    rows_.clear();
  }
  if (rows_.empty()) next_ = firstFrame(row);
  rows_.push_back(row);
  const double from = frameTime_s(next_) + moments_s_.front();
  while (rows_.size() > 2 && scene_.time_s(rows_[1]) <= from) rows_.pop_front();
}

bool LiveEye::isComplete(std::uint64_t number) const {
  return !rows_.empty() && frameTime_s(number) + moments_s_.back() <= scene_.time_s(rows_.back()) + 1e-12;
}

LiveRow LiveEye::rowAt(double time_s) const {
  const auto after = std::ranges::find_if(rows_, [&](const LiveRow& row) { return scene_.time_s(row) >= time_s; });
  if (after == rows_.begin()) return *after;
  if (after == rows_.end()) return rows_.back();
  const LiveRow& before = *std::prev(after);
  const double part = (time_s - scene_.time_s(before)) / (scene_.time_s(*after) - scene_.time_s(before));
  return scene_.between(before, *after, part);
}

void LiveEye::catchUp() {
  while (isComplete(next_ + 1)) ++next_;
}

void LiveEye::look(const LiveRow& row, std::optional<Eigen::Vector2d> aside, std::size_t moment) {
  const ScenePose pose = scene_.pose(row);
  builder_.setPose(pose);
  PinholePicture& picture = pictures_[moment];
  RenderOptions options = builder_.renderOptions();
  options.sameShadows = moment != moments_s_.size() / 2;
  Pinhole pinhole = pipeline_.pinhole();
  if (aside) {
    options.supersampling = 1;
    pinhole.centreX_px -= aside->x();
    pinhole.centreY_px -= aside->y();
  }
  if (!renderer_.look(builder_.node(), pose.others.at(robot_).at(link_) * mount_, pinhole, options, picture,
                      seen_[moment]))
    throw InputError("camera", "OpenGL: " + renderer_.problem().toStdString(),
                     "a machine with OpenGL; Mesa's software driver will do (libegl-mesa0, libgl1-mesa-dri)");
  picture.pinhole = pipeline_.pinhole();
}

EyeFrame LiveEye::frameOf(std::uint64_t number, double time_s, const std::vector<LiveRow>& moments,
                          const LiveRow& now) {
  EyeFrame frame;
  frame.number = number;
  frame.time_s = time_s;
  pictures_.resize(moments.size());
  // The shutter averages over moments: each takes one sample a pixel, at another place in it. The middle one, which the
  // truth is read from, takes it in the middle; it is drawn first, and its shadows are those of all.
  const std::size_t middle = moments.size() / 2;
  const auto take = [&](std::size_t i) {
    constexpr double third = 1.0 / 3;
    const double side = i == middle ? 0 : i % 2 == 0 ? third : -third;
    const auto aside =
        moments.size() == 1 ? std::nullopt : std::optional<Eigen::Vector2d>({i < middle ? side : -side, side});
    look(moments[i], aside, i);
  };
  take(middle);
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (i != middle) take(i);
  frame.picture = pipeline_.process(pictures_, number);
  for (const int joint : joints_) frame.joints.push_back(now.values.at(static_cast<std::size_t>(joint)));
  return frame;
}

std::optional<EyeFrame> LiveEye::next() {
  if (!isComplete(next_)) return std::nullopt;
  const double time_s = frameTime_s(next_);
  std::vector<LiveRow> moments;
  for (const double moment : moments_s_) moments.push_back(rowAt(time_s + moment));
  return frameOf(next_++, time_s, moments, rowAt(time_s));
}

std::optional<EyeFrame> LiveEye::still() {
  if (rows_.empty()) return std::nullopt;
  const LiveRow& now = rows_.back();
  return frameOf(next_, scene_.time_s(now), std::vector<LiveRow>(moments_s_.size(), now), now);
}

std::string cameraOf(const std::string& modelName) {
  std::string name;
  for (const char c : modelName)
    if (std::isalnum(static_cast<unsigned char>(c))) name += static_cast<char>(std::tolower(c));
  for (const char* known : {"ers7", "ers210", "ers220"})
    if (name.find(known) != std::string::npos) return name.find("ers7") != std::string::npos ? "ers7" : "ers210";
  return {};
}

}  // namespace btr::ui
