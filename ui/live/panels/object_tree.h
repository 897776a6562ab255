#pragma once
#include <QTreeWidget>
#include <string>
#include <vector>

namespace btr::ui {
class LiveWorld;

/// The objects by team and kind, robots with their joints and links; several can be selected, names are changed in
/// place (F2).
class ObjectTree : public QTreeWidget {
  Q_OBJECT
 public:
  explicit ObjectTree(LiveWorld& world, QWidget* parent = nullptr);
  void showObjects();
  void showSelected();
  /// Null: no such object.
  QTreeWidgetItem* itemOf(const std::string& object) const;

 signals:
  void renameWanted(const std::string& object, const std::string& name);
  void jointChosen(const std::string& robot, const std::string& joint);

 private:
  QTreeWidgetItem* groupOf(const std::string& object);
  void addParts(QTreeWidgetItem* robot);
  void takeSelection();
  void takeName(QTreeWidgetItem* item);

  LiveWorld& world_;
};

}  // namespace btr::ui
