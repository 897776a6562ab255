#pragma once
#include <osg/Camera>
#include <osg/Group>
#include <osg/Uniform>

#include <Eigen/Geometry>

namespace btr::ui {

/// Shadows of the sun from one depth map of the same fineness everywhere, which several views can share. What lies
/// outside of it is lit.
class SunMap {
 public:
  /// Of so many texels each way; `drawn` casts shadows where it carries kCastsShadow, and receives them.
  SunMap(osg::Node& drawn, int size);

  /// What belongs into the graph: draws the map, then `drawn` with it.
  osg::Group& node() { return *node_; }
  /// The map holds a ball about a place in the world. Draws it with the next frame and no further one.
  void aim(const Eigen::Vector3d& middle, double radius_m);
  /// The map is left as it is.
  void keep();
  bool isDrawn() const { return drawn_; }
  /// Before each frame; `view`: world → camera.
  void look(const Eigen::Matrix4d& view);

 private:
  int size_;
  bool drawn_ = false;
  osg::ref_ptr<osg::Group> node_ = new osg::Group;
  osg::ref_ptr<osg::Camera> camera_ = new osg::Camera;
  osg::ref_ptr<osg::Uniform> toMap_;
};

}  // namespace btr::ui
