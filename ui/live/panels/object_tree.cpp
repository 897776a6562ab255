#include "ui/live/panels/object_tree.h"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QTreeWidgetItemIterator>
#include <algorithm>

#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/live/live_world.h"

namespace btr::ui {
namespace {

enum Role { objectRole = Qt::UserRole, jointRole };

QString objectOf(const QTreeWidgetItem* item) { return item->data(0, objectRole).toString(); }

}  // namespace

ObjectTree::ObjectTree(LiveWorld& world, QWidget* parent) : QTreeWidget(parent), world_(world) {
  setObjectName("liveObjects");
  setAccessibleName(tr("Objects"));
  setToolTip(tr("Ctrl and Shift select several; F2 changes a name"));
  setHeaderHidden(true);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setEditTriggers(QAbstractItemView::EditKeyPressed);
  connect(this, &QTreeWidget::itemSelectionChanged, this, &ObjectTree::takeSelection);
  connect(this, &QTreeWidget::itemChanged, this, &ObjectTree::takeName);
}

QTreeWidgetItem* ObjectTree::groupOf(const std::string& object) {
  const int index = world_.indexOf(object);
  QString title = tr("Obstacles"), icon = "view-grid";
  const LiveObject::Kind kind = world_.objects()[std::size_t(index)].kind;
  if (kind == LiveObject::Kind::ball) title = tr("Balls");
  if (kind == LiveObject::Kind::robot) {
    const std::string team = world_.playerOf(object).team;
    title = team == "red" ? tr("Red team") : team == "blue" ? tr("Blue team") : tr("Robots");
  }
  for (int i = 0; i < topLevelItemCount(); ++i)
    if (topLevelItem(i)->text(0) == title) return topLevelItem(i);
  auto* group = new QTreeWidgetItem(this, {title});
  group->setFlags(Qt::ItemIsEnabled);
  // A field has dozens of posts and walls.
  group->setExpanded(kind != LiveObject::Kind::obstacle || world_.objects().size() < 12);
  return group;
}

void ObjectTree::showObjects() {
  const QSignalBlocker quiet(this);
  QStringList open;
  for (int i = 0; i < topLevelItemCount(); ++i)
    if (topLevelItem(i)->isExpanded()) open << topLevelItem(i)->text(0);
  const bool first = topLevelItemCount() == 0;
  clear();
  for (const LiveObject& object : world_.objects()) {
    QTreeWidgetItem* group = groupOf(object.name);
    auto* item = new QTreeWidgetItem(group, {word(object.name)});
    item->setData(0, objectRole, word(object.name));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable);
    if (object.kind == LiveObject::Kind::robot) addParts(item);
  }
  for (int i = 0; !first && i < topLevelItemCount(); ++i)
    if (open.contains(topLevelItem(i)->text(0))) topLevelItem(i)->setExpanded(true);
}

void ObjectTree::addParts(QTreeWidgetItem* robot) {
  const std::string name = objectOf(robot).toStdString();
  const auto spec = std::ranges::find(world_.game().scene.robots, name, &RobotSpec::name);
  const RobotModel& model = *world_.models().at(spec->model);
  auto* joints = new QTreeWidgetItem(robot, {tr("joints")});
  auto* links = new QTreeWidgetItem(robot, {tr("links")});
  for (QTreeWidgetItem* group : {joints, links}) group->setFlags(Qt::ItemIsEnabled);
  const auto add = [&](QTreeWidgetItem* group, const std::string& part) {
    auto* item = new QTreeWidgetItem(group, {word(part)});
    item->setData(0, objectRole, word(name));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    return item;
  };
  for (const Joint& joint : model.joints)
    if (joint.type != Joint::Type::fixed) add(joints, joint.name)->setData(0, jointRole, word(joint.name));
  for (const Link& link : model.links) add(links, link.name);
}

QTreeWidgetItem* ObjectTree::itemOf(const std::string& object) const {
  for (int i = 0; i < topLevelItemCount(); ++i)
    for (int k = 0; k < topLevelItem(i)->childCount(); ++k)
      if (objectOf(topLevelItem(i)->child(k)) == word(object)) return topLevelItem(i)->child(k);
  return nullptr;
}

// A joint or a link stands for its robot.
void ObjectTree::takeSelection() {
  std::vector<std::string> objects = world_.selection(), chosen;
  for (const QTreeWidgetItem* item : selectedItems()) chosen.push_back(objectOf(item).toStdString());
  std::erase_if(objects, [&](const std::string& name) { return std::ranges::find(chosen, name) == chosen.end(); });
  for (const std::string& name : chosen)
    if (std::ranges::find(objects, name) == objects.end()) objects.push_back(name);
  // The one with the focus is shown.
  if (const QTreeWidgetItem* current = currentItem(); current && current->isSelected()) {
    const std::string name = objectOf(current).toStdString();
    std::erase(objects, name);
    objects.push_back(name);
    if (const QString joint = current->data(0, jointRole).toString(); !joint.isEmpty())
      emit jointChosen(name, joint.toStdString());
  }
  if (objects != world_.selection()) world_.select(objects);
}

void ObjectTree::showSelected() {
  const QSignalBlocker quiet(this);
  for (QTreeWidgetItemIterator at(this); *at; ++at) {
    const bool wanted = std::ranges::find(world_.selection(), objectOf(*at).toStdString()) != world_.selection().end();
    // A joint that was chosen stays chosen with its robot.
    if (!wanted || (*at)->parent() == nullptr || (*at)->parent()->parent() == nullptr) (*at)->setSelected(wanted);
  }
  QTreeWidgetItem* shown = itemOf(world_.selected());
  if (!shown) return;
  if (currentItem() && objectOf(currentItem()) == objectOf(shown)) return;
  setCurrentItem(shown, 0, QItemSelectionModel::NoUpdate);
  scrollToItem(shown);
}

void ObjectTree::takeName(QTreeWidgetItem* item) {
  const QString object = objectOf(item), name = item->text(0).trimmed();
  if (object.isEmpty() || !(item->flags() & Qt::ItemIsEditable) || name == object) return;
  {
    const QSignalBlocker quiet(this);
    item->setText(0, object);  // until it is done
  }
  emit renameWanted(object.toStdString(), name.toStdString());
}

}  // namespace btr::ui
