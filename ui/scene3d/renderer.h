#pragma once
#include <QColor>
#include <QImage>
#include <QSize>
#include <QString>
#include <memory>

#include "ui/scene3d/gl_context.h"
#include "ui/scene3d/view_camera.h"

namespace osg {
class Node;
}

namespace btr::ui {

/// How a picture is taken.
struct RenderOptions {
  bool shadows = true;
  bool sameShadows = false;  ///< of a measurement: they may stay as in the one before, of nearly the same moment
  int supersampling = 2;     ///< 1 or 2: pixels rendered per pixel of the picture, along each axis
  QColor skyTop{214, 223, 232};
  QColor skyHorizon{240, 242, 244};
};

/// From anywhere towards the sun, in the world's frame: where shadows come from. Unit length.
Eigen::Vector3d sunDirection();

/// Nodes that carry this bit in their mask cast shadows; everything that is drawn receives them.
inline constexpr unsigned kCastsShadow = 2;
inline constexpr unsigned kCastsNoShadow = 1;

/// Draws an OpenSceneGraph scene into an image, without a window. The context is made by the first call of render, and
/// belongs to that thread from then on; several renderers may live in one process. The same scene gives the same bits.
class OffscreenRenderer {
 public:
  explicit OffscreenRenderer(GlContextFactory factory = createGlContext);
  ~OffscreenRenderer();
  OffscreenRenderer(const OffscreenRenderer&) = delete;
  OffscreenRenderer& operator=(const OffscreenRenderer&) = delete;

  /// A picture of `size` pixels, 1 … 4096 each way; a null image if there is no OpenGL, problem() then says why.
  /// The renderer shares ownership of the scene that it drew last.
  QImage render(osg::Node& scene, const ViewCamera& camera, QSize size, const RenderOptions& options = {});
  /// For people; empty as long as nothing went wrong.
  const QString& problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::ui
