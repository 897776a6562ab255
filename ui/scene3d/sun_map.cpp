#include "ui/scene3d/sun_map.h"

#include <osg/PolygonOffset>
#include <osg/Texture2D>

#include "ui/scene3d/renderer.h"
#include "ui/scene3d/shader_program.h"
#include "ui/scene3d/shaders.h"

namespace btr::ui {
namespace {

constexpr int textureUnit = 1;
constexpr double away_m = 100;  ///< the map's camera from its middle; nearly parallel to what levels of detail measure
constexpr double bias_m = 0.004;  ///< nearer to the sun than this above a surface nothing shades it

osg::ref_ptr<osg::Texture2D> depthTexture(int size) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
  texture->setTextureSize(size, size);
  texture->setInternalFormat(GL_DEPTH_COMPONENT24);
  texture->setSourceFormat(GL_DEPTH_COMPONENT);
  texture->setShadowComparison(true);
  texture->setShadowTextureMode(osg::Texture2D::LUMINANCE);
  for (const auto filter : {osg::Texture2D::MIN_FILTER, osg::Texture2D::MAG_FILTER})
    texture->setFilter(filter, osg::Texture2D::LINEAR);
  for (const auto side : {osg::Texture2D::WRAP_S, osg::Texture2D::WRAP_T})
    texture->setWrap(side, osg::Texture2D::CLAMP_TO_BORDER);
  texture->setBorderColor(osg::Vec4(1, 1, 1, 1));
  return texture;
}

}  // namespace

SunMap::SunMap(osg::Node& drawn, int size)
    : size_(size), toMap_(new osg::Uniform(osg::Uniform::FLOAT_MAT4, "toSunMap")) {
  osg::ref_ptr<osg::Texture2D> depth = depthTexture(size);
  camera_->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
  camera_->setRenderOrder(osg::Camera::PRE_RENDER);
  camera_->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera_->attach(osg::Camera::DEPTH_BUFFER, depth);
  camera_->setClearMask(GL_DEPTH_BUFFER_BIT);
  camera_->setViewport(0, 0, size, size);
  camera_->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera_->setCullMask(kCastsShadow);
  constexpr auto wins = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
  osg::StateSet& casting = *camera_->getOrCreateStateSet();
  casting.setAttribute(shaderProgram({shaders::kCastVertex}, {shaders::kCastFragment}), wins);
  casting.setAttributeAndModes(new osg::PolygonOffset(2, 4), wins);
  casting.setMode(GL_SCISSOR_TEST, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  camera_->addChild(&drawn);

  osg::ref_ptr<osg::Group> receivers = new osg::Group;
  osg::StateSet& receiving = *receivers->getOrCreateStateSet();
  receiving.setAttribute(shaderProgram({shaders::kMainVertex, shaders::kSunMapVertex},
                                       {measuring(shaders::kMainFragment), shaders::kSunMapFragment}));
  receiving.setTextureAttribute(textureUnit, depth);
  receiving.addUniform(new osg::Uniform("sunMap", textureUnit));
  receiving.addUniform(new osg::Uniform("sunTexel", 1.f / float(size)));
  receiving.addUniform(toMap_);
  receivers->addChild(&drawn);
  node_->addChild(camera_);
  node_->addChild(receivers);
}

void SunMap::aim(const Eigen::Vector3d& middle, double radius_m) {
  const Eigen::Vector3d eye = middle + away_m * sunDirection();
  camera_->setViewMatrixAsLookAt(osg::Vec3d(eye.x(), eye.y(), eye.z()), osg::Vec3d(middle.x(), middle.y(), middle.z()),
                                 osg::Vec3d(0, 0, 1));
  // So far towards the sun things still cast, and so far behind the middle they still receive.
  camera_->setProjectionMatrixAsOrtho(-radius_m, radius_m, -radius_m, radius_m, away_m - 2 * radius_m,
                                      away_m + 2 * radius_m);
  constexpr double coarser = 2;  // than a view would need whose pixels are the texels: edges are soft
  camera_->setLODScale(float(coarser * 2 * radius_m / size_ / away_m));
  camera_->setNodeMask(~0u);
  drawn_ = true;
}

void SunMap::keep() { camera_->setNodeMask(0); }

void SunMap::look(const Eigen::Matrix4d& view) {
  const osg::Matrixd fromCamera = osg::Matrixd::inverse(osg::Matrixd(view.data()));
  const osg::Matrixd towardsSun = osg::Matrixd::translate(0, 0, bias_m);
  toMap_->set(osg::Matrixf(fromCamera * camera_->getViewMatrix() * towardsSun * camera_->getProjectionMatrix() *
                           osg::Matrixd::translate(1, 1, 1) * osg::Matrixd::scale(0.5, 0.5, 0.5)));
}

}  // namespace btr::ui
