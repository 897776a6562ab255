#include "ui/scene3d/render_stage.h"

#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/LightSource>
#include <osg/Texture2D>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/ShadowSettings>

#include "ui/scene3d/shader_program.h"
#include "ui/scene3d/shaders.h"

namespace btr::ui {
namespace {

/// Of a picture for people, where the map is finer near the eye, and of a measurement.
constexpr int kShadowMapSize = 2048, kSunMapSize = 1024;

/// After the grounds of SceneBuilder, before what is translucent.
constexpr int kSkyBin = 5;

osg::ref_ptr<osg::Shader> shader(osg::Shader::Type type, const char* text) { return new osg::Shader(type, text); }

/// A quad behind the whole picture, drawn where nothing solid is; it has no extent that would move clipping planes or
/// shadows.
osg::ref_ptr<osg::Geometry> makeSky(const std::string& fragment) {
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
  state.setAttribute(shaderProgram({shaders::kSkyVertex}, {fragment}));
  state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  state.setRenderBinDetails(kSkyBin, "RenderBin");
  return sky;
}

osg::Vec3 rgb(const QColor& colour) { return {float(colour.redF()), float(colour.greenF()), float(colour.blueF())}; }

}  // namespace

/// Light-space perspective shadow map with our own shading and a polygon offset that neither speckles nor detaches.
class RenderStage::SunShadow final : public osgShadow::LightSpacePerspectiveShadowMapVB {
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

RenderStage::RenderStage(Target target, GlContextFactory factory) : target_(target), factory_(std::move(factory)) {}

RenderStage::~RenderStage() {
  if (!context_ || !context_->makeCurrent()) return;
  // Give buffers and textures back while their context still lives; other stages keep theirs.
  root_->releaseGLObjects(window_->getState());
  viewer_ = nullptr;
  window_->close();
  context_->release();
}

/// The graph: root → sky, and either `plain` or `shadowed` → `lit` → light, scene. Shadows of a measurement are those
/// of a SunMap.
void RenderStage::build() {
  osg::ref_ptr<osg::Light> light = new osg::Light;
  light->setLightNum(0);
  const Eigen::Vector3f sun = sunDirection().cast<float>();
  light->setPosition(osg::Vec4(sun.x(), sun.y(), sun.z(), 0));
  lit_ = new osg::Group;
  osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
  source->setLight(light);
  lit_->addChild(source);

  const bool measured = target_ == Target::measurement;
  const auto fragment = [&](const char* text) { return measured ? measuring(text) : std::string(text); };
  plain_ = new osg::Group;
  plain_->addChild(lit_);
  plain_->getOrCreateStateSet()->setAttribute(
      shaderProgram({shaders::kMainVertex, shaders::kNoShadowVertex},
                    {fragment(shaders::kMainFragment), shaders::kNoShadowFragment}));
  if (measured) {
    sunMap_ = std::make_unique<SunMap>(*lit_, kSunMapSize);
    shadowed_ = &sunMap_->node();
  } else {
    buildFineShadows(*light);
  }
  root_->addChild(makeSky(fragment(shaders::kSkyFragment)));
  root_->addChild(plain_);
  root_->addChild(shadowed_);
  osg::StateSet& state = *root_->getOrCreateStateSet();
  for (auto& [uniform, name] : {std::pair{&skyTop_, "skyTop"}, {&skyHorizon_, "skyHorizon"}, {&up_, "up"}}) {
    *uniform = new osg::Uniform(name, osg::Vec3());
    state.addUniform(*uniform);
  }
  if (measured) state.setAttributeAndModes(rows_);
  viewport_ = new osg::Uniform("viewport", osg::Vec2());
  state.addUniform(viewport_);
  state.addUniform(new osg::Uniform("shadowTexel", 1.f / float(kShadowMapSize)));
  for (const char* name : {"unlit", "fade", "weave", "identity"}) state.addUniform(new osg::Uniform(name, 0.f));
  state.addUniform(new osg::Uniform("gloss", 0.25f));
  state.addUniform(new osg::Uniform("opacity", 1.f));
}

void RenderStage::buildFineShadows(osg::Light& light) {
  sunShadow_ = new SunShadow(&light);
  osg::ref_ptr<osgShadow::ShadowedScene> shadowed = new osgShadow::ShadowedScene(sunShadow_);
  shadowed->getShadowSettings()->setReceivesShadowTraversalMask(~0u);
  shadowed->getShadowSettings()->setCastsShadowTraversalMask(kCastsShadow);
  shadowed->addChild(lit_);
  shadowed_ = shadowed;
}

void RenderStage::start() {
  build();
  window_ = new osgViewer::GraphicsWindowEmbedded(0, 0, 16, 16);
  viewer_ = new osgViewer::Viewer;
  viewer_->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer_->setReleaseContextAtEndOfFrameHint(false);
  viewer_->setLightingMode(osg::View::NO_LIGHT);
  viewer_->setKeyEventSetsDone(0);
  // The picture is the master camera's own target: shadows turn black in nested cameras.
  osg::Camera& camera = *viewer_->getCamera();
  camera.setGraphicsContext(window_);
  camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
  viewer_->setSceneData(root_);
}

void RenderStage::resize(QSize wanted) {
  if (pixels_ == wanted) return;
  pixels_ = wanted;
  const int w = pixels_.width(), h = pixels_.height();
  const bool measured = target_ == Target::measurement;
  if (measured) {
    colour_->allocateImage(w, h, 1, GL_RGBA, GL_FLOAT);
    depth_->allocateImage(w, h, 1, GL_DEPTH_COMPONENT, GL_FLOAT);
    depth_->setInternalTextureFormat(GL_DEPTH_COMPONENT24);
  } else {
    colour_->allocateImage(w, h, 1, GL_BGRA, GL_UNSIGNED_BYTE);
  }
  colour_->setInternalTextureFormat(measured ? GL_RGBA32F_ARB : GL_RGBA8);
  window_->resized(0, 0, w, h);
  osg::Camera& camera = *viewer_->getCamera();
  camera.setViewport(0, 0, w, h);
  camera.detach(osg::Camera::COLOR_BUFFER);
  camera.detach(osg::Camera::DEPTH_BUFFER);
  camera.attach(osg::Camera::COLOR_BUFFER, colour_);
  if (measured)
    camera.attach(osg::Camera::DEPTH_BUFFER, depth_);
  else
    camera.attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
  camera.dirtyAttachmentMap();
  viewport_->set(osg::Vec2(w, h));
}

void RenderStage::aimShadows(const RenderView& view, const RenderOptions& options) {
  if (sunShadow_) return sunShadow_->setMaxFarPlane(float(view.shadowReach_m));
  if (options.sameShadows && sunMap_->isDrawn()) {
    sunMap_->keep();
  } else if (options.shadows) {
    constexpr double wide = 0.6;  // of the reach around its middle: the corners of a wide view, too
    const Eigen::Matrix4d toWorld = view.view.inverse();
    const Eigen::Vector3d eye = toWorld.block<3, 1>(0, 3), ahead = -toWorld.block<3, 1>(0, 2);
    sunMap_->aim(eye + view.shadowReach_m / 2 * ahead, wide * view.shadowReach_m);
  }
  sunMap_->look(view.view);
}

bool RenderStage::draw(osg::Node& scene, const RenderView& view, QSize pixels, const RenderOptions& options) {
  if (!problem_.isEmpty()) return false;
  if (!context_) {
    context_ = factory_(problem_);
    if (!context_) return false;
    problem_.clear();
    if (context_->makeCurrent()) start();
  }
  if (!context_->makeCurrent()) {
    problem_ = "the OpenGL context cannot be made current";
    return false;
  }
  if (scene_ != &scene) {
    if (scene_) lit_->removeChild(scene_);
    scene_ = &scene;
    lit_->addChild(scene_);
  }
  plain_->setNodeMask(options.shadows ? 0 : ~0u);
  shadowed_->setNodeMask(options.shadows ? ~0u : 0);
  aimShadows(view, options);
  skyTop_->set(rgb(options.skyTop));
  skyHorizon_->set(rgb(options.skyHorizon));
  resize(pixels);
  const PictureRows rows = view.rows.value_or(PictureRows{0, pixels.height() - 1});
  rows_->setScissor(0, rows.first, pixels.width(), rows.last + 1 - rows.first);
  osg::Camera& camera = *viewer_->getCamera();
  camera.setViewMatrix(osg::Matrixd(view.view.data()));
  camera.setProjectionMatrixAsFrustum(view.left, view.right, view.bottom, view.top, view.near_m, view.far_m);
  // Few enough triangles for the pixels, where the scene has levels; fine shadows inherit it.
  camera.setLODScale(float((view.top - view.bottom) / view.near_m / pixels.height()));
  up_->set(osg::Vec3(osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), camera.getViewMatrix())));
  viewer_->frame(0.0);
  context_->release();
  return true;
}

// High over the right side of a robot that looks along x.
Eigen::Vector3d sunDirection() { return Eigen::Vector3d(0.17, -0.64, 0.88).normalized(); }

}  // namespace btr::ui
