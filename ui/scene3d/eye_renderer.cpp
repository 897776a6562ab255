#include "ui/scene3d/eye_renderer.h"

#include <limits>

#include "ui/scene3d/render_stage.h"

namespace btr::ui {
namespace {

constexpr double farthest_m = 30;

/// World → camera as OpenGL has it: x right, y up, −z ahead.
Eigen::Matrix4d viewOf(const Eigen::Isometry3d& camera) {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  return (Eigen::Isometry3d(axes) * camera.inverse()).matrix();
}

/// The edges of the pixels lie half a pixel around their centres.
RenderView frustumOf(const Eigen::Isometry3d& camera, const Pinhole& pinhole, double near_m) {
  RenderView view;
  view.view = viewOf(camera);
  view.near_m = near_m;
  view.far_m = farthest_m;
  const double scale = near_m / pinhole.focal_px;
  view.left = -scale * (pinhole.centreX_px + 0.5);
  view.right = scale * (pinhole.width - 0.5 - pinhole.centreX_px);
  view.top = scale * (pinhole.centreY_px + 0.5);
  view.bottom = -scale * (pinhole.height - 0.5 - pinhole.centreY_px);
  view.shadowReach_m = 6;
  return view;
}

}  // namespace

struct EyeRenderer::Impl {
  RenderStage stage;
};

EyeRenderer::EyeRenderer(GlContextFactory factory)
    : impl_(new Impl{{RenderStage::Target::measurement, std::move(factory)}}) {}
EyeRenderer::~EyeRenderer() = default;
const QString& EyeRenderer::problem() const { return impl_->stage.problem(); }

bool EyeRenderer::look(osg::Node& scene, const Eigen::Isometry3d& camera, const Pinhole& pinhole,
                       const RenderOptions& options, PinholePicture& picture, std::optional<PictureRows> rows,
                       double near_m) {
  const int factor = options.supersampling == 1 ? 1 : 2;
  RenderView view = frustumOf(camera, pinhole, near_m);
  const QSize size(pinhole.width, pinhole.height);
  const int firstRow = rows ? rows->first : 0, lastRow = rows ? rows->last : size.height() - 1;
  view.rows = {factor * (size.height() - 1 - lastRow), factor * (size.height() - firstRow) - 1};
  if (!impl_->stage.draw(scene, view, size * factor, options)) return false;
  const auto count = static_cast<std::size_t>(size.width()) * static_cast<std::size_t>(size.height());
  picture.pinhole = pinhole;
  picture.rgb.resize(3 * count);
  picture.depth_m.resize(count);
  picture.object.resize(count);
  const auto* light = reinterpret_cast<const float*>(impl_->stage.colour().data());
  const auto* depth = reinterpret_cast<const float*>(impl_->stage.depth().data());
  const int stride = size.width() * factor;
  const double share = 1.0 / (factor * factor), n = view.near_m, f = view.far_m;
  std::size_t pixel = std::size_t(firstRow) * std::size_t(size.width());
  for (int y = firstRow; y <= lastRow; ++y)
    for (int x = 0; x < size.width(); ++x, ++pixel) {
      const std::size_t first = std::size_t(size.height() - 1 - y) * factor * stride + std::size_t(x) * factor;
      float sum[3] = {0, 0, 0};
      for (int dy = 0; dy < factor; ++dy)
        for (int dx = 0; dx < factor; ++dx)
          for (int channel = 0; channel < 3; ++channel) sum[channel] += light[4 * (first + dy * stride + dx) + channel];
      for (int channel = 0; channel < 3; ++channel) picture.rgb[3 * pixel + channel] = float(sum[channel] * share);
      picture.object[pixel] = static_cast<std::uint16_t>(light[4 * first + 3] + 0.5f);
      // The depth buffer holds d = f/(f − n)·(1 − n/z).
      const double d = depth[first];
      picture.depth_m[pixel] = d >= 1 ? std::numeric_limits<float>::infinity() : float(n * f / (f - d * (f - n)));
    }
  return true;
}

}  // namespace btr::ui
