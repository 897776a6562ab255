#include "ui/scene3d/mesh_simplify.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

namespace btr::ui {
namespace {

using Eigen::Vector3d;

/// Mean square distance from planes, weighed by their areas.
struct Quadric {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Vector3d products = Vector3d::Zero();
  double constant = 0, weight = 0;

  void addPlane(const Vector3d& normal, const Vector3d& through, double area) {
    const double offset = -normal.dot(through);
    squares += area * normal * normal.transpose();
    products += area * offset * normal;
    constant += area * offset * offset;
    weight += area;
  }
  void add(const Quadric& other) {
    squares += other.squares;
    products += other.products;
    constant += other.constant;
    weight += other.weight;
  }
  double at(const Vector3d& place) const {
    if (weight <= 0) return 0;
    return std::max(0.0, (place.dot(squares * place) + 2 * products.dot(place) + constant) / weight);
  }
};

using Point = std::size_t;  ///< a place at which vertices of the mesh lie

struct Face {
  std::array<Point, 3> corners;
  unsigned vertex;  ///< of the mesh: has the face's colour
  bool gone = false;

  bool has(Point point) const { return std::ranges::find(corners, point) != corners.end(); }
};

/// What an edge costs that is drawn together into its end `to`, as its ends were at that time.
struct Collapse {
  double cost;
  Point from, to;
  int fromVersion, toVersion;

  /// The cheapest is on top of the queue; of equal ones always the same.
  bool operator<(const Collapse& other) const {
    return std::tie(other.cost, other.from, other.to) < std::tie(cost, from, to);
  }
};

class Simplifier {
 public:
  Simplifier(const TriangleMesh& mesh, double error_m) : mesh_(mesh), most_(error_m * error_m) {
    weld();
    for (const Face& face : faces_) {
      const Vector3d across = acrossOf(face);
      const double area = across.norm();
      if (area > 0)
        for (const Point corner : face.corners) quadrics_[corner].addPlane(across / area, places_[corner], area);
    }
    holdEdges();
  }

  TriangleMesh run() {
    for (Point point = 0; point < places_.size(); ++point) offerFrom(point);
    while (!offers_.empty()) {
      const Collapse next = offers_.top();
      offers_.pop();
      if (next.fromVersion == versions_[next.from] && next.toVersion == versions_[next.to] && isAllowed(next))
        collapse(next);
    }
    return left();
  }

 private:
  void weld() {
    // Rounding separates what is drawn as one.
    constexpr double same_m = 1e-6;
    std::map<std::array<long, 3>, Point> points;
    const auto cell = [](float coordinate) { return std::lround(double(coordinate) / same_m); };
    std::vector<Point> pointOf;
    for (const Eigen::Vector3f& position : mesh_.positions) {
      const auto [place, isNew] =
          points.try_emplace({cell(position.x()), cell(position.y()), cell(position.z())}, places_.size());
      if (isNew) places_.emplace_back(position.cast<double>());
      pointOf.push_back(place->second);
    }
    vertices_.resize(places_.size());
    for (unsigned vertex = 0; vertex < pointOf.size(); ++vertex) vertices_[pointOf[vertex]].push_back(vertex);
    around_.resize(places_.size());
    quadrics_.resize(places_.size());
    versions_.assign(places_.size(), 0);
    for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
      const Face face{{pointOf[mesh_.indices[i]], pointOf[mesh_.indices[i + 1]], pointOf[mesh_.indices[i + 2]]},
                      mesh_.indices[i]};
      const auto& [a, b, c] = face.corners;
      if (a == b || b == c || c == a) continue;
      for (const Point corner : face.corners) around_[corner].push_back(faces_.size());
      faces_.push_back(face);
    }
  }

  const Colour& colourOf(const Face& face) const { return mesh_.colours[face.vertex]; }

  /// At right angles to the face, twice its area long.
  Vector3d acrossOf(const Face& face) const {
    const auto& [a, b, c] = face.corners;
    return (places_[b] - places_[a]).cross(places_[c] - places_[a]);
  }

  /// Upright planes on edges where a surface or a colour ends, as heavy as the faces beside them.
  void holdEdges() {
    std::map<std::pair<Point, Point>, std::vector<std::size_t>> edges;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      for (int side = 0; side < 3; ++side)
        edges[std::minmax(faces_[i].corners[side], faces_[i].corners[(side + 1) % 3])].push_back(i);
    for (const auto& [ends, faces] : edges) {
      if (faces.size() == 2 && colourOf(faces_[faces[0]]) == colourOf(faces_[faces[1]])) continue;
      const Vector3d along = places_[ends.second] - places_[ends.first];
      for (const std::size_t face : faces) {
        const Vector3d upright = along.cross(acrossOf(faces_[face]));
        const double length = upright.norm();
        if (length <= 0) continue;
        constexpr double heavier = 4;
        for (const Point end : {ends.first, ends.second})
          quadrics_[end].addPlane(upright / length, places_[end], heavier * along.squaredNorm());
      }
    }
  }

  std::vector<Point> neighboursOf(Point point) const {
    std::vector<Point> neighbours;
    for (const std::size_t face : around_[point])
      for (const Point corner : faces_[face].corners)
        if (corner != point) neighbours.push_back(corner);
    std::ranges::sort(neighbours);
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    return neighbours;
  }

  void offer(Point from, Point to) {
    Quadric both = quadrics_[from];
    both.add(quadrics_[to]);
    const double cost = both.at(places_[to]);
    if (cost <= most_) offers_.push({cost, from, to, versions_[from], versions_[to]});
  }
  void offerFrom(Point point) {
    for (const Point neighbour : neighboursOf(point)) offer(point, neighbour);
  }

  /// The surface neither folds over nor grows together.
  bool isAllowed(const Collapse& collapse) const {
    const std::vector<Point> ofFrom = neighboursOf(collapse.from), ofTo = neighboursOf(collapse.to);
    std::vector<Point> common;
    std::ranges::set_intersection(ofFrom, ofTo, std::back_inserter(common));
    if (common.size() > 2) return false;
    for (const std::size_t index : around_[collapse.from]) {
      Face face = faces_[index];
      if (face.has(collapse.to)) continue;
      const Vector3d before = acrossOf(face);
      std::ranges::replace(face.corners, collapse.from, collapse.to);
      const Vector3d after = acrossOf(face);
      constexpr double mostTurn = 0.5;  // cosine
      if (before.dot(after) <= mostTurn * before.norm() * after.norm()) return false;
    }
    return true;
  }

  void collapse(const Collapse& collapse) {
    const auto [cost, from, to, fromVersion, toVersion] = collapse;
    for (const std::size_t index : around_[from]) {
      Face& face = faces_[index];
      face.gone = face.has(to);
      if (face.gone) continue;
      std::ranges::replace(face.corners, from, to);
      around_[to].push_back(index);
    }
    const std::vector<Point> touched = neighboursOf(from);
    around_[from].clear();
    for (const Point point : touched)
      std::erase_if(around_[point], [this](std::size_t face) { return faces_[face].gone; });
    std::erase_if(around_[to], [this](std::size_t face) { return faces_[face].gone; });
    quadrics_[to].add(quadrics_[from]);
    ++versions_[from];
    ++versions_[to];
    offerFrom(to);
    for (const Point neighbour : neighboursOf(to)) offer(neighbour, to);
  }

  TriangleMesh left() const {
    TriangleMesh mesh;
    std::map<std::pair<unsigned, Colour>, unsigned> made;
    for (const Face& face : faces_) {
      if (face.gone) continue;
      const Vector3d across = acrossOf(face);
      for (const Point corner : face.corners) {
        const unsigned vertex = vertexOf(corner, across);
        const auto [place, isNew] =
            made.try_emplace({vertex, colourOf(face)}, static_cast<unsigned>(mesh.positions.size()));
        if (isNew) {
          mesh.positions.push_back(mesh_.positions[vertex]);
          mesh.normals.push_back(mesh_.normals[vertex]);
          mesh.colours.push_back(colourOf(face));
        }
        mesh.indices.push_back(place->second);
      }
    }
    return mesh;
  }

  /// Of those at a point the one whose normal looks most as the face does.
  unsigned vertexOf(Point point, const Vector3d& across) const {
    return *std::ranges::max_element(vertices_[point], {},
                                     [&](unsigned vertex) { return mesh_.normals[vertex].cast<double>().dot(across); });
  }

  const TriangleMesh& mesh_;
  const double most_;
  std::vector<Vector3d> places_;
  std::vector<std::vector<unsigned>> vertices_;  ///< of the mesh, by point
  std::vector<Face> faces_;
  std::vector<std::vector<std::size_t>> around_;  ///< faces that are not gone, by point
  std::vector<Quadric> quadrics_;
  std::vector<int> versions_;
  std::priority_queue<Collapse> offers_;
};

}  // namespace

TriangleMesh simplified(const TriangleMesh& mesh, double error_m) { return Simplifier(mesh, error_m).run(); }

}  // namespace btr::ui
