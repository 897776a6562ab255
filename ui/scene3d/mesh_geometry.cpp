#include "ui/scene3d/mesh_geometry.h"

#include <osg/LOD>
#include <osg/Uniform>

#include <limits>

#include "ui/scene3d/mesh_simplify.h"

namespace btr::ui {
namespace {

template <typename Array, typename Values>
osg::ref_ptr<Array> copied(const Values& values) {
  osg::ref_ptr<Array> array = new Array;
  array->reserve(values.size());
  for (const auto& value : values) {
    typename Array::ElementDataType element;
    for (int i = 0; i < Array::ElementDataType::num_components; ++i) element[i] = value[i];
    array->push_back(element);
  }
  return array;
}

}  // namespace

void useBuffers(osg::Geometry& geometry) {
  geometry.setUseDisplayList(false);
  geometry.setUseVertexBufferObjects(true);
}

osg::ref_ptr<osg::Geometry> toGeometry(const TriangleMesh& mesh, float gloss) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  useBuffers(*geometry);
  geometry->setVertexArray(copied<osg::Vec3Array>(mesh.positions));
  geometry->setNormalArray(copied<osg::Vec3Array>(mesh.normals), osg::Array::BIND_PER_VERTEX);
  geometry->setColorArray(copied<osg::Vec4Array>(mesh.colours), osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES, mesh.indices.size(), mesh.indices.data()));
  geometry->getOrCreateStateSet()->addUniform(new osg::Uniform("gloss", gloss));
  return geometry;
}

osg::ref_ptr<osg::Node> toLevels(const TriangleMesh& mesh, float gloss) {
  constexpr double errors_mm[] = {0.3, 0.6, 1.2, 2.5, 5.0};
  constexpr double worth = 0.8;        // of the corners, else a level is left out
  constexpr std::size_t few = 3 * 24;  // corners of a mesh that is cheap as it is
  osg::ref_ptr<osg::LOD> levels = new osg::LOD;
  TriangleMesh finer = mesh;
  double from = 0;  // size of a pixel [m], times the tolerance
  for (const double error_mm : errors_mm) {
    if (finer.indices.size() <= few) break;
    TriangleMesh coarser = simplified(finer, 1e-3 * error_mm);
    if (double(coarser.indices.size()) > worth * double(finer.indices.size())) continue;
    const double to = 1e-3 * error_mm / mostError_px;
    levels->addChild(toGeometry(finer, gloss), float(from), float(to));
    finer = std::move(coarser);
    from = to;
  }
  osg::ref_ptr<osg::Geometry> last = toGeometry(finer, gloss);
  if (levels->getNumChildren() == 0) return last;
  levels->addChild(last, float(from), std::numeric_limits<float>::max());
  return levels;
}

}  // namespace btr::ui
