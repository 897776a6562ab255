#pragma once
#include <Eigen/Geometry>
#include <QObject>
#include <map>
#include <string>

namespace btr::ui {
class LiveWorld;

/// What mouse and keys do to what is selected: all of it together, and as one step of undo.
class LiveHands : public QObject {
  Q_OBJECT
 public:
  explicit LiveHands(LiveWorld& world, QObject* parent = nullptr);

  /// A drag: this object is led there, the others that are selected as far. By hand while the world waits, by springs
  /// while it runs.
  void lead(const std::string& object, const Eigen::Vector3d& place_m);
  void endDrag();
  /// By hand; while the world runs what moves is pulled by a spring, whose other end is moved on.
  void move(const Eigen::Vector3d& by_m, double turn_rad);
  /// Of everything that is pulled.
  void letGo();
  void removeSelected();

 private:
  LiveWorld& world_;
  std::map<std::string, Eigen::Isometry3d> ledFrom_;  ///< of a drag: where what is selected was when it began
};

}  // namespace btr::ui
