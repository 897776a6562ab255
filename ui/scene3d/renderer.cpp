#include "ui/scene3d/renderer.h"

#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/LightSource>
#include <osg/Program>
#include <osg/Texture2D>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowedScene>
#include <osgViewer/Viewer>

#include "ui/scene3d/shaders.h"

namespace btr::ui {
namespace {

constexpr int kShadowMapSize = 2048;

osg::ref_ptr<osg::Shader> shader(osg::Shader::Type type, const char* text) { return new osg::Shader(type, text); }

/// Light-space perspective shadow map with our own shading and a polygon offset that neither speckles nor detaches.
class SunShadow final : public osgShadow::LightSpacePerspectiveShadowMapVB {
 public:
  explicit SunShadow(osg::Light* light) {
    setLight(light);
    setTextureSize(osg::Vec2s(kShadowMapSize, kShadowMapSize));
    setMinLightMargin(0.5f);
    _polygonOffsetFactor = 4;
    _polygonOffsetUnits = 16;
    setMainVertexShader(shader(osg::Shader::VERTEX, shaders::kMainVertex));
    setMainFragmentShader(shader(osg::Shader::FRAGMENT, shaders::kMainFragment));
    setShadowVertexShader(shader(osg::Shader::VERTEX, shaders::kShadowVertex));
    setShadowFragmentShader(shader(osg::Shader::FRAGMENT, shaders::kShadowFragment));
  }
};

/// A quad over the whole picture, drawn first; it has no extent that would move clipping planes or shadows.
osg::ref_ptr<osg::Geometry> makeSky() {
  struct NoBound final : osg::Drawable::ComputeBoundingBoxCallback {
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
  };
  osg::ref_ptr<osg::Geometry> sky = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] : {std::pair{-1.f, -1.f}, {1.f, -1.f}, {1.f, 1.f}, {-1.f, 1.f}})
    corners->push_back({x, y, 0});
  sky->setVertexArray(corners);
  sky->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  sky->setComputeBoundingBoxCallback(new NoBound);
  sky->setCullingActive(false);
  sky->setUseDisplayList(false);
  sky->setUseVertexBufferObjects(true);
  osg::StateSet& state = *sky->getOrCreateStateSet();
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(shader(osg::Shader::VERTEX, shaders::kSkyVertex));
  program->addShader(shader(osg::Shader::FRAGMENT, shaders::kSkyFragment));
  state.setAttribute(program);
  state.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false));
  state.setRenderBinDetails(-10, "RenderBin");
  return sky;
}

osg::Vec3 rgb(const QColor& colour) { return {float(colour.redF()), float(colour.greenF()), float(colour.blueF())}; }

/// Turns OpenGL's bottom-up image round and averages blocks of `factor` × `factor` pixels.
QImage toPicture(const osg::Image& source, QSize size, int factor) {
  QImage result(size, QImage::Format_RGB32);
  for (int y = 0; y < size.height(); ++y) {
    auto* out = reinterpret_cast<QRgb*>(result.scanLine(y));
    for (int x = 0; x < size.width(); ++x) {
      unsigned sum[3] = {0, 0, 0};
      for (int dy = 0; dy < factor; ++dy) {
        const unsigned char* in = source.data(x * factor, (size.height() - 1 - y) * factor + dy);
        for (int dx = 0; dx < factor; ++dx, in += 4)
          for (int channel = 0; channel < 3; ++channel) sum[channel] += in[channel];
      }
      const unsigned area = factor * factor, half = area / 2;
      out[x] = qRgb((sum[2] + half) / area, (sum[1] + half) / area, (sum[0] + half) / area);
    }
  }
  return result;
}

}  // namespace

struct OffscreenRenderer::Impl {
  GlContextFactory factory;
  std::unique_ptr<GlContext> context;
  QString problem;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window;
  osg::ref_ptr<osgViewer::Viewer> viewer;
  osg::ref_ptr<osg::Image> image = new osg::Image;
  osg::ref_ptr<osg::Group> root = new osg::Group;
  osg::ref_ptr<osg::Group> lit;                     ///< the light and the scene
  osg::ref_ptr<osg::Group> plain;                   ///< draws `lit` without shadows
  osg::ref_ptr<osgShadow::ShadowedScene> shadowed;  ///< draws `lit` with shadows
  osg::ref_ptr<SunShadow> sunShadow;
  osg::ref_ptr<osg::Node> scene;
  osg::ref_ptr<osg::Uniform> skyTop, skyHorizon, viewport, up;
  QSize pixels;

  void build();
  void start();
  void resize(QSize wanted);
};

/// The graph: root → sky, and either `plain` or `shadowed` → lit → light, scene.
void OffscreenRenderer::Impl::build() {
  osg::ref_ptr<osg::Light> light = new osg::Light;
  light->setLightNum(0);
  const Eigen::Vector3f sun = sunDirection().cast<float>();
  light->setPosition(osg::Vec4(sun.x(), sun.y(), sun.z(), 0));
  lit = new osg::Group;
  osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
  source->setLight(light);
  lit->addChild(source);

  plain = new osg::Group;
  plain->addChild(lit);
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(shader(osg::Shader::VERTEX, shaders::kMainVertex));
  program->addShader(shader(osg::Shader::VERTEX, shaders::kNoShadowVertex));
  program->addShader(shader(osg::Shader::FRAGMENT, shaders::kMainFragment));
  program->addShader(shader(osg::Shader::FRAGMENT, shaders::kNoShadowFragment));
  plain->getOrCreateStateSet()->setAttribute(program);

  sunShadow = new SunShadow(light);
  shadowed = new osgShadow::ShadowedScene(sunShadow);
  shadowed->getShadowSettings()->setReceivesShadowTraversalMask(~0u);
  shadowed->getShadowSettings()->setCastsShadowTraversalMask(kCastsShadow);
  shadowed->addChild(lit);

  root->addChild(makeSky());
  root->addChild(plain);
  root->addChild(shadowed);
  osg::StateSet& state = *root->getOrCreateStateSet();
  for (auto& [uniform, name] : {std::pair{&skyTop, "skyTop"}, {&skyHorizon, "skyHorizon"}, {&up, "up"}}) {
    *uniform = new osg::Uniform(name, osg::Vec3());
    state.addUniform(*uniform);
  }
  viewport = new osg::Uniform("viewport", osg::Vec2());
  state.addUniform(viewport);
  state.addUniform(new osg::Uniform("shadowTexel", 1.f / kShadowMapSize));
  for (const char* name : {"unlit", "fade", "weave"}) state.addUniform(new osg::Uniform(name, 0.f));
  state.addUniform(new osg::Uniform("gloss", 0.25f));
}

void OffscreenRenderer::Impl::start() {
  build();
  window = new osgViewer::GraphicsWindowEmbedded(0, 0, 16, 16);
  viewer = new osgViewer::Viewer;
  viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer->setReleaseContextAtEndOfFrameHint(false);
  viewer->setLightingMode(osg::View::NO_LIGHT);
  viewer->setKeyEventSetsDone(0);
  // The picture is the master camera's own target: shadows turn black in nested cameras.
  osg::Camera& camera = *viewer->getCamera();
  camera.setGraphicsContext(window);
  camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
  image->setInternalTextureFormat(GL_RGBA8);
  viewer->setSceneData(root);
}

void OffscreenRenderer::Impl::resize(QSize wanted) {
  if (pixels == wanted) return;
  pixels = wanted;
  const int w = pixels.width(), h = pixels.height();
  image->allocateImage(w, h, 1, GL_BGRA, GL_UNSIGNED_BYTE);
  image->setInternalTextureFormat(GL_RGBA8);
  window->resized(0, 0, w, h);
  osg::Camera& camera = *viewer->getCamera();
  camera.setViewport(0, 0, w, h);
  camera.detach(osg::Camera::COLOR_BUFFER);
  camera.detach(osg::Camera::DEPTH_BUFFER);
  camera.attach(osg::Camera::COLOR_BUFFER, image);
  camera.attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
  camera.dirtyAttachmentMap();
  viewport->set(osg::Vec2(w, h));
}

// High over the right side of a robot that looks along x.
Eigen::Vector3d sunDirection() { return Eigen::Vector3d(0.17, -0.64, 0.88).normalized(); }

OffscreenRenderer::OffscreenRenderer(GlContextFactory factory) : impl_(std::make_unique<Impl>()) {
  impl_->factory = std::move(factory);
}

OffscreenRenderer::~OffscreenRenderer() {
  if (!impl_->context || !impl_->context->makeCurrent()) return;
  // Give buffers and textures back while their context still lives; other renderers keep theirs.
  impl_->root->releaseGLObjects(impl_->window->getState());
  impl_->viewer = nullptr;
  impl_->window->close();
  impl_->context->release();
}

const QString& OffscreenRenderer::problem() const { return impl_->problem; }

QImage OffscreenRenderer::render(osg::Node& scene, const ViewCamera& camera, QSize size, const RenderOptions& options) {
  Impl& my = *impl_;
  if (!my.problem.isEmpty()) return {};
  const int factor = options.supersampling == 1 ? 1 : 2;
  size = size.boundedTo(QSize(4096, 4096)).expandedTo(QSize(1, 1));
  if (!my.context) {
    my.context = my.factory(my.problem);
    if (!my.context) return {};
    my.problem.clear();
    if (my.context->makeCurrent()) my.start();
  }
  if (!my.context->makeCurrent()) {
    my.problem = "the OpenGL context cannot be made current";
    return {};
  }

  // What is shown, from where, and how.
  if (my.scene != &scene) {
    if (my.scene) my.lit->removeChild(my.scene);
    my.scene = &scene;
    my.lit->addChild(my.scene);
  }
  my.plain->setNodeMask(options.shadows ? 0 : ~0u);
  my.shadowed->setNodeMask(options.shadows ? ~0u : 0);
  my.sunShadow->setMaxFarPlane(float(camera.distance + 4));
  my.skyTop->set(rgb(options.skyTop));
  my.skyHorizon->set(rgb(options.skyHorizon));
  my.resize(size * factor);
  osg::Camera& view = *my.viewer->getCamera();
  view.setViewMatrix(osg::Matrixd(camera.viewMatrix().eval().data()));
  view.setProjectionMatrixAsPerspective(camera.fieldOfView * 180 / std::numbers::pi,
                                        double(size.width()) / size.height(), camera.nearPlane(), camera.farPlane());
  const osg::Vec3d up = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), view.getViewMatrix());
  my.up->set(osg::Vec3(up));

  my.viewer->frame(0.0);
  QImage picture = toPicture(*my.image, size, factor);
  my.context->release();
  return picture;
}

}  // namespace btr::ui
