#pragma once
#include <osg/Image>
#include <osg/Scissor>
#include <osg/Uniform>
#include <osgShadow/ShadowedScene>
#include <osgViewer/Viewer>

#include <Eigen/Geometry>
#include <optional>

#include "core/camera/pinhole.h"
#include "ui/scene3d/renderer.h"
#include "ui/scene3d/sun_map.h"

namespace btr::ui {

/// From where a picture is taken: world → camera (x right, y up, −z ahead), and the window in the near plane [m].
struct RenderView {
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  double left = -1, right = 1, bottom = -1, top = 1;
  double near_m = 0.01, far_m = 25;
  double shadowReach_m = 5;         ///< from the eye
  std::optional<PictureRows> rows;  ///< of a measurement, from below: drawn are these alone. None: all
};

/// Light, shadows, sky and a scene in an OpenGL context of its own: what all renderers share. Belongs to the thread of
/// its first draw().
class RenderStage {
 public:
  enum class Target {
    picture,      ///< 8 bit a channel, as a screen shows it
    measurement,  ///< linear light as 32-bit floats, alpha is the object's number; depth as floats
  };
  RenderStage(Target target, GlContextFactory factory);
  ~RenderStage();
  RenderStage(const RenderStage&) = delete;
  RenderStage& operator=(const RenderStage&) = delete;

  /// False if there is no OpenGL: problem() then says why.
  bool draw(osg::Node& scene, const RenderView& view, QSize pixels, const RenderOptions& options);
  const osg::Image& colour() const { return *colour_; }  ///< bottom row first
  const osg::Image& depth() const { return *depth_; }    ///< of a measurement: 0 at the near plane, 1 at the far one
  const QString& problem() const { return problem_; }

 private:
  class SunShadow;
  void build();
  void buildFineShadows(osg::Light& light);
  void aimShadows(const RenderView& view, const RenderOptions& options);
  void start();
  void resize(QSize wanted);

  Target target_;
  GlContextFactory factory_;
  std::unique_ptr<GlContext> context_;
  QString problem_;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window_;
  osg::ref_ptr<osgViewer::Viewer> viewer_;
  osg::ref_ptr<osg::Image> colour_ = new osg::Image, depth_ = new osg::Image;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::Group> lit_;       ///< the light and the scene
  osg::ref_ptr<osg::Group> plain_;     ///< draws `lit_` without shadows
  osg::ref_ptr<osg::Group> shadowed_;  ///< draws `lit_` with shadows
  osg::ref_ptr<SunShadow> sunShadow_;  ///< of a picture
  std::unique_ptr<SunMap> sunMap_;     ///< of a measurement
  osg::ref_ptr<osg::Node> scene_;
  osg::ref_ptr<osg::Uniform> skyTop_, skyHorizon_, viewport_, up_;
  osg::ref_ptr<osg::Scissor> rows_ = new osg::Scissor;
  QSize pixels_;
};

}  // namespace btr::ui
