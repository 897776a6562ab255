#pragma once
#include <deque>
#include <optional>

#include "core/camera/camera_pipeline.h"
#include "ui/live/drawn/live_scene.h"
#include "ui/scene3d/eye_renderer.h"

namespace btr::ui {

/// One frame of a robot's camera.
struct EyeFrame {
  std::uint64_t number = 0;
  double time_s = 0;  ///< the middle of the exposure of the middle row
  CameraFrame picture;
  std::vector<double> joints;  ///< the robot's joint positions then, see LiveEye::jointColumns()
};

/// What a robot's camera sees of a running world: rows go in, frames come out at the camera's rate. Between two rows
/// everything moves evenly. Belongs to the thread of its first frame.
class LiveEye {
 public:
  /// Throws InputError if the game has no such robot, or the robot no link that the camera sits on.
  LiveEye(const Game& game, const ModelSet& models, const std::vector<std::string>& channels, const std::string& robot,
          CameraSpec camera, GlContextFactory factory = createGlContext);

  const CameraSpec& camera() const { return pipeline_.spec(); }
  /// Another camera on the same robot, or the same with other numbers. Throws InputError, and changes nothing, if the
  /// robot has no link for it.
  void setCamera(CameraSpec camera);
  /// As PinholePicture::object counts them, from 1.
  const std::vector<std::string>& objects() const { return objects_; }
  const std::vector<std::string>& jointColumns() const { return jointColumns_; }

  /// A row later than those before. Where the world went back in time, everything before is forgotten.
  void add(const LiveRow& row);
  /// The next frame that the rows complete; none as long as more rows are needed. Throws InputError without OpenGL.
  std::optional<EyeFrame> next();
  /// The world of the last row as if it stood still there, none before the first row. Does not count as a frame.
  std::optional<EyeFrame> still();
  /// Leaves frames out until the last one that the rows complete.
  void catchUp();

 private:
  double frameTime_s(std::uint64_t number) const { return static_cast<double>(number) / camera().frameRate_hz; }
  std::uint64_t firstFrame(const LiveRow& row) const;
  bool isComplete(std::uint64_t number) const;
  LiveRow rowAt(double time_s) const;
  /// The world as the pinhole of the camera sees it in a row; `aside` is where in its pixels samples lie, from their
  /// middle [pixels]: none takes four a pixel. The middle moment is the first; its shadows are those of all.
  void look(const LiveRow& row, std::optional<Eigen::Vector2d> aside, std::size_t moment);
  EyeFrame frameOf(std::uint64_t number, double time_s, const std::vector<LiveRow>& moments, const LiveRow& now);

  LiveScene scene_;
  std::size_t robot_ = 0;
  std::size_t link_ = 0;  ///< on which the camera sits
  CameraPipeline pipeline_;
  std::vector<double> moments_s_;
  std::vector<PictureRows> seen_;  ///< of each moment's picture
  Eigen::Isometry3d mount_;
  EyeRenderer renderer_;
  SceneBuilder builder_;
  std::vector<std::string> objects_, jointColumns_;
  std::vector<int> joints_;   ///< columns of jointColumns_
  std::deque<LiveRow> rows_;  ///< as far back as the next frame reaches
  std::uint64_t next_ = 0;
  std::vector<PinholePicture> pictures_;  ///< one a moment; kept for their memory
};

/// The camera of resources/cameras that belongs to a robot's model, by its name; "" none does.
std::string cameraOf(const std::string& modelName);

}  // namespace btr::ui
