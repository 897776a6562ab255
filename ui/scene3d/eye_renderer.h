#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/camera/pinhole.h"
#include "ui/scene3d/renderer.h"

namespace btr::ui {

/// Measures what a camera without lens errors sees of an OpenSceneGraph scene, without a window: linear light, depth
/// and which object each pixel shows (the uniform "identity" of its node, see SceneBuilder). Belongs to the thread of
/// its first look(). The same scene gives the same bits on the same driver.
class EyeRenderer {
 public:
  explicit EyeRenderer(GlContextFactory factory = createGlContext);
  ~EyeRenderer();
  EyeRenderer(const EyeRenderer&) = delete;
  EyeRenderer& operator=(const EyeRenderer&) = delete;

  /// `camera`: its frame in the world (x along the optical axis, y left, z up). False if there is no OpenGL: problem()
  /// says why. Nothing nearer than `near_m` is seen. With `rows` the picture is drawn in these alone, where it has the
  /// same bits; others are left as they are.
  bool look(osg::Node& scene, const Eigen::Isometry3d& camera, const Pinhole& pinhole, const RenderOptions& options,
            PinholePicture& picture, std::optional<PictureRows> rows = std::nullopt, double near_m = 0.01);
  const QString& problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::ui
