#include "ui/scene3d/renderer.h"

#include <osg/Image>

#include "ui/scene3d/render_stage.h"

namespace btr::ui {
namespace {

/// Turns OpenGL's bottom-up image round and averages blocks of `factor` × `factor` pixels.
QImage toPicture(const osg::Image& source, QSize size, int factor) {
  QImage result(size, QImage::Format_RGB32);
  const unsigned char* pixels = source.data();
  const std::size_t row = source.getRowStepInBytes();
  const unsigned area = factor * factor, half = area / 2;
  for (int y = 0; y < size.height(); ++y) {
    auto* out = reinterpret_cast<QRgb*>(result.scanLine(y));
    const unsigned char* below = pixels + static_cast<std::size_t>(size.height() - 1 - y) * factor * row;
    for (int x = 0; x < size.width(); ++x) {
      unsigned sum[3] = {0, 0, 0};
      for (int dy = 0; dy < factor; ++dy) {
        const unsigned char* in = below + dy * row + std::size_t(4) * x * factor;
        for (int dx = 0; dx < factor; ++dx, in += 4)
          for (int channel = 0; channel < 3; ++channel) sum[channel] += in[channel];
      }
      out[x] = qRgb((sum[2] + half) / area, (sum[1] + half) / area, (sum[0] + half) / area);
    }
  }
  return result;
}

}  // namespace

struct OffscreenRenderer::Impl {
  RenderStage stage;
};

OffscreenRenderer::OffscreenRenderer(GlContextFactory factory)
    : impl_(new Impl{{RenderStage::Target::picture, std::move(factory)}}) {}

OffscreenRenderer::~OffscreenRenderer() = default;

const QString& OffscreenRenderer::problem() const { return impl_->stage.problem(); }

QImage OffscreenRenderer::render(osg::Node& scene, const ViewCamera& camera, QSize size, const RenderOptions& options) {
  const int factor = options.supersampling == 1 ? 1 : 2;
  size = size.boundedTo(QSize(4096, 4096)).expandedTo(QSize(1, 1));
  RenderView view;
  view.view = camera.viewMatrix();
  view.near_m = camera.nearPlane();
  view.far_m = camera.farPlane();
  view.top = view.near_m * std::tan(camera.fieldOfView / 2);
  view.right = view.top * size.width() / size.height();
  view.bottom = -view.top;
  view.left = -view.right;
  view.shadowReach_m = camera.distance + 4;
  if (!impl_->stage.draw(scene, view, size * factor, options)) return {};
  return toPicture(impl_->stage.colour(), size, factor);
}

}  // namespace btr::ui
