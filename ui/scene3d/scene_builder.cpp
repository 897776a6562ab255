#include "ui/scene3d/scene_builder.h"

#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/LineWidth>
#include <osg/MatrixTransform>
#include <osg/Point>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>

#include <algorithm>
#include <limits>
#include <map>

#include "ui/scene3d/field.h"
#include "ui/scene3d/link_marks.h"
#include "ui/scene3d/mesh_geometry.h"
#include "ui/scene3d/triangle_mesh.h"

namespace btr::ui {
namespace {

const std::string kJackets[] = {"red", "blue"};
constexpr unsigned kHidden = 0;

osg::Matrixd matrix(const Eigen::Isometry3d& pose) { return osg::Matrixd(pose.matrix().data()); }

osg::ref_ptr<osg::Geometry> toGeometry(const LineSegments& lines, const Colour& colour) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  useBuffers(*geometry);
  osg::ref_ptr<osg::Vec3Array> ends = new osg::Vec3Array;
  ends->reserve(lines.size());
  for (const Eigen::Vector3f& end : lines) ends->push_back({end.x(), end.y(), end.z()});
  geometry->setVertexArray(ends);
  osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array;
  colours->push_back({colour[0], colour[1], colour[2], colour[3]});
  geometry->setColorArray(colours, osg::Array::BIND_OVERALL);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<int>(lines.size())));
  osg::StateSet& state = *geometry->getOrCreateStateSet();
  state.addUniform(new osg::Uniform("unlit", 1.f));
  state.setAttribute(new osg::LineWidth(2.f));
  geometry->setNodeMask(kCastsNoShadow);
  return geometry;
}

Colour colourOf(Mark mark) {
  switch (mark) {
    case Mark::collision:
      return {0.95f, 0.15f, 0.75f, 1};
    case Mark::boxes:
      return {0.95f, 0.75f, 0.10f, 1};
    case Mark::axes:
      return {0.15f, 0.45f, 0.95f, 1};
    case Mark::centres:
      return {0.05f, 0.65f, 0.60f, 1};
    case Mark::contacts:
      return {0.90f, 0.20f, 0.10f, 1};
    case Mark::trails:
      return {0.45f, 0.25f, 0.80f, 1};
  }
  return {};
}

/// Seen through bodies: what explains them lies inside.
void drawOnTop(osg::Node& node) {
  osg::StateSet& state = *node.getOrCreateStateSet();
  state.setRenderBinDetails(50, "RenderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  state.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false));
}

/// Blended in a bin of its own after everything solid. With `depthOnly` it first fills only the depth buffer, so that
/// only the nearest surface of a ghost shows and not its insides.
void makeTranslucent(osg::Node& node, int bin, bool depthOnly) {
  osg::StateSet& state = *node.getOrCreateStateSet();
  state.setRenderBinDetails(bin, "RenderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  if (depthOnly) {
    state.setAttribute(new osg::ColorMask(false, false, false, false));
  } else {
    // What shines through keeps its object's number, which a measurement has in alpha.
    state.setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE));
    state.addUniform(new osg::Uniform("identity", 0.f));
    state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  }
}

/// The bodies of a link; robots of one model share them. Null: none.
struct LinkBodies {
  osg::ref_ptr<osg::Node> common, clear, jackets[2];
};

/// By link. With a colour everything is drawn in it; with `levels` with fewer triangles where it is small.
std::vector<LinkBodies> bodiesOf(const RobotModel& model, const Colour* colour, bool levels) {
  const auto drawn = [levels](const TriangleMesh& mesh, float gloss) -> osg::ref_ptr<osg::Node> {
    if (mesh.empty()) return nullptr;
    osg::ref_ptr<osg::Node> node;
    if (levels)
      node = toLevels(mesh, gloss);
    else
      node = toGeometry(mesh, gloss);
    node->setNodeMask(kCastsShadow);
    return node;
  };
  std::vector<LinkBodies> bodies;
  for (const Link& link : model.links) {
    TriangleMesh common, clear, jacket[2];
    for (const Shape& shape : link.shapes) {
      if (!shape.drawn) continue;
      TriangleMesh* mesh = &common;
      for (int i = 0; i < 2; ++i)
        if (shape.part == kJackets[i]) mesh = &jacket[i];
      if (!colour && mesh == &common && shape.colour[3] < 1) mesh = &clear;
      mesh->addShape(shape, shape.pose, colour ? *colour : shape.colour);
    }
    bodies.push_back({drawn(common, 0.30f), drawn(clear, 0.6f), {drawn(jacket[0], 0.12f), drawn(jacket[1], 0.12f)}});
    if (bodies.back().clear) makeTranslucent(*bodies.back().clear, 10, false);
  }
  return bodies;
}

/// One drawn body: a robot and balls whose parts follow a pose. The solid one and every ghost are such.
struct Figure {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  std::vector<osg::ref_ptr<osg::MatrixTransform>> links, balls;
  std::vector<osg::ref_ptr<osg::Node>> jackets[2], marks[kMarks];

  /// With a colour everything is drawn in it, without collision outlines: a ghost. Bodies are those of the model.
  Figure(const RobotModel* model, const std::vector<LinkBodies>& bodies, const std::vector<double>& radii,
         const Colour* colour) {
    for (const LinkBodies& link : bodies) links.push_back(addLink(link));
    if (model && !colour) addMarks(*model);
    for (double radius : radii) {
      balls.push_back(new osg::MatrixTransform);
      TriangleMesh mesh = ballMesh(radius);
      if (colour) mesh.colours.assign(mesh.colours.size(), *colour);
      balls.back()->addChild(toGeometry(mesh, 0.35f));
      group->addChild(balls.back());
    }
  }

  void place(const ScenePose& pose) {
    move(links, pose.links);
    move(balls, pose.balls);
    if (hiddenLink < links.size()) links[hiddenLink]->setNodeMask(kHidden);
  }
  std::size_t hiddenLink = std::numeric_limits<std::size_t>::max();

  /// What a measurement tells of each.
  void number(int robot, int firstBall) {
    for (auto& link : links) link->getOrCreateStateSet()->addUniform(new osg::Uniform("identity", float(robot)));
    for (auto& ball : balls) ball->getOrCreateStateSet()->addUniform(new osg::Uniform("identity", float(firstBall++)));
  }

  void showJacket(const std::string& part) {
    for (int i = 0; i < 2; ++i)
      for (auto& node : jackets[i]) node->setNodeMask(kJackets[i] == part ? kCastsShadow : kHidden);
  }

 private:
  static void move(std::vector<osg::ref_ptr<osg::MatrixTransform>>& nodes,
                   const std::vector<Eigen::Isometry3d>& poses) {
    // A trial that exploded may have ended in poses that are no numbers.
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const bool known = poses.size() >= nodes.size() && poses[i].matrix().allFinite();
      nodes[i]->setNodeMask(known ? ~0u : kHidden);
      if (known) nodes[i]->setMatrix(matrix(poses[i]));
    }
  }

  osg::ref_ptr<osg::MatrixTransform> addLink(const LinkBodies& bodies) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
    for (const auto& body : {bodies.common, bodies.clear})
      if (body) transform->addChild(body);
    for (int i = 0; i < 2; ++i) {
      if (!bodies.jackets[i]) continue;
      osg::ref_ptr<osg::Group> worn = new osg::Group;  // shown or not for this robot alone
      worn->setNodeMask(kHidden);
      worn->addChild(bodies.jackets[i]);
      transform->addChild(worn);
      jackets[i].push_back(worn);
    }
    group->addChild(transform);
    return transform;
  }

  void addMarks(const RobotModel& model) {
    const std::vector<LinkMarks> lines = marksOf(model);
    for (std::size_t i = 0; i < links.size(); ++i) {
      LineSegments collision;
      for (const Shape& shape : model.links[i].shapes)
        if (shape.collides) addOutline(collision, shape, shape.pose);
      const auto add = [&](Mark mark, const LineSegments& segments) {
        if (segments.empty()) return;
        osg::ref_ptr<osg::Geometry> geometry = toGeometry(segments, colourOf(mark));
        if (mark == Mark::axes || mark == Mark::centres) drawOnTop(*geometry);
        geometry->setNodeMask(kHidden);
        links[i]->addChild(geometry);
        marks[std::size_t(mark)].push_back(geometry);
      };
      add(Mark::collision, collision);
      add(Mark::boxes, lines[i].box);
      add(Mark::axes, lines[i].axes);
      add(Mark::axes, lines[i].limits);
      add(Mark::centres, lines[i].centre);
    }
  }
};

}  // namespace

struct SceneBuilder::Impl {
  osg::ref_ptr<osg::Group> root = new osg::Group, ground = new osg::Group, body = new osg::Group,
                           ghosts = new osg::Group;
  std::shared_ptr<const RobotModel> model;
  std::vector<double> radii;
  ScenePose pose;
  std::vector<Ghost> ghostPoses;
  std::vector<Figure> ghostFigures;
  std::unique_ptr<Figure> figure;
  std::vector<std::shared_ptr<const RobotModel>> furtherModels;
  std::vector<Figure> further;
  std::string jacket = "red";
  std::vector<std::string> furtherJackets;
  Ground groundKind = Ground::field;
  std::optional<CarpetSpec> carpet;
  std::optional<std::pair<std::size_t, std::size_t>> hiddenLink;
  std::array<bool, kMarks> shown{};
  WorldMarks worldMarks;
  osg::ref_ptr<osg::Group> worldLines = new osg::Group;
  std::map<std::shared_ptr<const RobotModel>, std::vector<LinkBodies>> bodies;  ///< of the robots that are there
  bool dark = false, levels = false;
  int firstFurther = 2;

  void rebuildFigure();
  void rebuildGhosts();
  void rebuildGround();
  void showMarks() {
    const auto show = [this](const Figure& figure) {
      for (std::size_t mark = 0; mark < kMarks; ++mark)
        for (const auto& node : figure.marks[mark]) node->setNodeMask(shown[mark] ? kCastsNoShadow : kHidden);
    };
    show(*figure);
    for (const Figure& other : further) show(other);
  }
  void rebuildWorldLines() {
    worldLines->removeChildren(0, worldLines->getNumChildren());
    const auto add = [this](Mark mark, const LineSegments& lines) {
      if (!shown[std::size_t(mark)] || lines.empty()) return;
      worldLines->addChild(toGeometry(lines, colourOf(mark)));
    };
    add(Mark::contacts, contactLines(worldMarks.contacts));
    add(Mark::trails, trailLines(worldMarks.trails));
  }
  void place() {
    for (std::size_t i = 0; i < further.size(); ++i)
      further[i].hiddenLink =
          hiddenLink && hiddenLink->first == i ? hiddenLink->second : std::numeric_limits<std::size_t>::max();
    figure->place(pose);
    for (std::size_t i = 0; i < further.size(); ++i)
      further[i].place({i < pose.others.size() ? pose.others[i] : std::vector<Eigen::Isometry3d>(), {}, {}});
  }
  void showJacket() {
    figure->showJacket(jacket);
    for (std::size_t i = 0; i < further.size(); ++i) {
      const bool own = i < furtherJackets.size() && !furtherJackets[i].empty();
      further[i].showJacket(own ? furtherJackets[i] : jacket);
    }
  }
};

void SceneBuilder::Impl::rebuildFigure() {
  pose = {};
  std::map<std::shared_ptr<const RobotModel>, std::vector<LinkBodies>> used;
  const auto of = [&](const std::shared_ptr<const RobotModel>& each) -> const std::vector<LinkBodies>& {
    const auto [place, isNew] = used.try_emplace(each);
    if (isNew && each) {
      if (const auto known = bodies.find(each); known != bodies.end())
        place->second = known->second;
      else
        place->second = bodiesOf(*each, nullptr, levels);
    }
    return place->second;
  };
  figure = std::make_unique<Figure>(model.get(), of(model), radii, nullptr);
  further.clear();
  for (const auto& other : furtherModels) further.emplace_back(other.get(), of(other), std::vector<double>(), nullptr);
  bodies = std::move(used);
  // Ground, first robot if there is one, further robots, balls.
  firstFurther = model ? 3 : 2;
  figure->number(2, firstFurther + static_cast<int>(further.size()));
  for (std::size_t i = 0; i < further.size(); ++i) further[i].number(firstFurther + static_cast<int>(i), 0);
  showJacket();
  place();
  showMarks();
  body->removeChildren(0, body->getNumChildren());
  body->addChild(figure->group);
  for (const Figure& other : further) body->addChild(other.group);
  ghostPoses.clear();
  rebuildGhosts();
}

void SceneBuilder::Impl::rebuildGhosts() {
  ghosts->removeChildren(0, ghosts->getNumChildren());
  ghostFigures.clear();
  int bin = 20;
  for (const Ghost& ghost : ghostPoses) {
    const Colour colour{float(ghost.colour.redF()), float(ghost.colour.greenF()), float(ghost.colour.blueF()),
                        float(ghost.colour.alphaF())};
    Figure shape(model.get(), model ? bodiesOf(*model, &colour, false) : std::vector<LinkBodies>(), radii, &colour);
    shape.showJacket(jacket);
    shape.place(ghost.pose);
    for (bool depthOnly : {true, false}) {
      osg::ref_ptr<osg::Group> pass = new osg::Group;
      makeTranslucent(*pass, bin++, depthOnly);
      pass->setNodeMask(kCastsNoShadow);
      pass->addChild(shape.group);
      ghosts->addChild(pass);
    }
    ghostFigures.push_back(std::move(shape));
  }
}

void SceneBuilder::Impl::rebuildGround() {
  ground->removeChildren(0, ground->getNumChildren());
  if (groundKind == Ground::none) return;
  const auto add = [this](const TriangleMesh& mesh, float gloss, unsigned mask) -> osg::StateSet& {
    osg::ref_ptr<osg::Geometry> geometry = toGeometry(mesh, gloss);
    geometry->setNodeMask(mask);
    ground->addChild(geometry);
    return *geometry->getOrCreateStateSet();
  };
  // Floors sink behind what lies on them, and the outermost one into the horizon. They are drawn after what hides them,
  // lowest last: pixels that are not seen are not shaded.
  const float shade = groundKind == Ground::field ? 0.75f : 0.66f;
  const Colour floor = dark ? Colour{0.20f, 0.21f, 0.23f, 1} : Colour{shade, shade, shade + 0.02f, 1};
  const auto sink = [](osg::StateSet& state, int amount) {
    state.setAttributeAndModes(new osg::PolygonOffset(float(amount), float(amount)));
    state.setRenderBinDetails(amount, "RenderBin");
  };
  osg::StateSet& around = add(plainFloor(14, groundKind == Ground::field ? -0.004 : 0, floor), 0, kCastsNoShadow);
  around.addUniform(new osg::Uniform("fade", 12.f));
  sink(around, 2);
  if (groundKind == Ground::plain && carpet) {
    osg::StateSet& cloth = add(carpetCloth(*carpet), 0, kCastsNoShadow);
    cloth.addUniform(new osg::Uniform("weave", 0.30f));
    sink(cloth, 1);
    add(carpetLines(*carpet), 0, kCastsNoShadow);
    return;
  }
  if (groundKind == Ground::plain) {
    const Colour grid = dark ? Colour{0.30f, 0.31f, 0.34f, 1} : Colour{0.50f, 0.52f, 0.55f, 1};
    add(floorGrid(3, grid), 0, kCastsNoShadow).addUniform(new osg::Uniform("fade", 4.f));
    return;
  }
  const FieldSize size;
  osg::StateSet& carpet = add(fieldCarpet(size), 0, kCastsNoShadow);
  carpet.addUniform(new osg::Uniform("weave", 0.30f));
  sink(carpet, 1);
  add(fieldLines(size), 0, kCastsNoShadow);
  add(fieldFixtures(size), 0.15f, kCastsShadow);
  add(fieldWall(size), 0, kCastsNoShadow);
}

SceneBuilder::SceneBuilder() : impl_(std::make_unique<Impl>()) {
  for (auto& part : {impl_->ground, impl_->body, impl_->ghosts, impl_->worldLines}) impl_->root->addChild(part);
  drawOnTop(*impl_->worldLines);
  impl_->ground->getOrCreateStateSet()->addUniform(new osg::Uniform("identity", float(groundNumber())));
  impl_->rebuildFigure();
  impl_->rebuildGround();
}

SceneBuilder::~SceneBuilder() = default;

osg::Node& SceneBuilder::node() const { return *impl_->root; }
const ScenePose& SceneBuilder::pose() const { return impl_->pose; }

void SceneBuilder::setRobot(std::shared_ptr<const RobotModel> model) {
  impl_->model = std::move(model);
  impl_->rebuildFigure();
}

void SceneBuilder::setLevels(bool levels) {
  impl_->levels = levels;
  impl_->bodies.clear();
  impl_->rebuildFigure();
}

void SceneBuilder::setFurtherRobots(std::vector<std::shared_ptr<const RobotModel>> models) {
  impl_->furtherModels = std::move(models);
  impl_->rebuildFigure();
}

void SceneBuilder::setBalls(std::vector<double> radii_m) {
  impl_->radii = std::move(radii_m);
  impl_->rebuildFigure();
}

void SceneBuilder::setPose(const ScenePose& pose) {
  impl_->pose = pose;
  impl_->place();
}

void SceneBuilder::setGhosts(std::vector<Ghost> ghosts) {
  // In a replay the same ghosts only move.
  const auto sameColour = [](const Ghost& a, const Ghost& b) { return a.colour == b.colour; };
  const bool same =
      std::equal(ghosts.begin(), ghosts.end(), impl_->ghostPoses.begin(), impl_->ghostPoses.end(), sameColour);
  impl_->ghostPoses = std::move(ghosts);
  if (!same) return impl_->rebuildGhosts();
  for (std::size_t i = 0; i < impl_->ghostPoses.size(); ++i) impl_->ghostFigures[i].place(impl_->ghostPoses[i].pose);
}

void SceneBuilder::setGround(Ground ground) {
  impl_->groundKind = ground;
  impl_->rebuildGround();
}

void SceneBuilder::setCarpet(std::optional<CarpetSpec> carpet) {
  impl_->carpet = std::move(carpet);
  impl_->rebuildGround();
}

void SceneBuilder::hideLink(std::optional<std::pair<std::size_t, std::size_t>> furtherRobotAndLink) {
  impl_->hiddenLink = furtherRobotAndLink;
  impl_->place();
}

std::uint16_t SceneBuilder::furtherNumber(std::size_t further) const {
  return static_cast<std::uint16_t>(static_cast<std::size_t>(impl_->firstFurther) + further);
}

std::uint16_t SceneBuilder::ballNumber(std::size_t ball) const { return furtherNumber(impl_->further.size() + ball); }

void SceneBuilder::setJacket(const std::string& part) {
  impl_->jacket = part;
  impl_->showJacket();
  impl_->rebuildGhosts();
}

void SceneBuilder::setFurtherJackets(std::vector<std::string> parts) {
  impl_->furtherJackets = std::move(parts);
  impl_->showJacket();
}

void SceneBuilder::setSurfaces(Surfaces surfaces) {
  osg::StateSet& state = *impl_->body->getOrCreateStateSet();
  state.removeAttribute(osg::StateAttribute::POLYGONMODE);
  state.removeAttribute(osg::StateAttribute::BLENDFUNC);
  state.removeAttribute(osg::StateAttribute::DEPTH);
  state.removeAttribute(osg::StateAttribute::POINT);
  state.removeUniform("opacity");
  state.setRenderBinToInherit();
  const auto polygons = [&](osg::PolygonMode::Mode mode) {
    state.setAttribute(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, mode));
  };
  if (surfaces == Surfaces::wireframe) polygons(osg::PolygonMode::LINE);
  if (surfaces == Surfaces::points) {
    polygons(osg::PolygonMode::POINT);
    state.setAttribute(new osg::Point(5.f));
  }
  if (surfaces != Surfaces::transparent) return;
  makeTranslucent(*impl_->body, 10, false);
  state.addUniform(new osg::Uniform("opacity", 0.35f));
}

void SceneBuilder::setMark(Mark mark, bool on) {
  impl_->shown[std::size_t(mark)] = on;
  impl_->showMarks();
  impl_->rebuildWorldLines();
}

void SceneBuilder::setWorldMarks(WorldMarks marks) {
  impl_->worldMarks = std::move(marks);
  impl_->rebuildWorldLines();
}

void SceneBuilder::setDark(bool dark) {
  impl_->dark = dark;
  impl_->rebuildGround();
}

RenderOptions SceneBuilder::renderOptions() const {
  RenderOptions options;
  if (impl_->dark) {
    options.skyTop = QColor(28, 31, 37);
    options.skyHorizon = QColor(52, 56, 63);
  }
  return options;
}

}  // namespace btr::ui
