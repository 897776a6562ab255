#include "core/model/urdf/urdf_tree.h"

#include <algorithm>
#include <unordered_set>

#include "core/model/kinematics.h"
#include "core/spec/error.h"

namespace btr {
namespace {

class TreeMaker {
 public:
  TreeMaker(UrdfTree tree, const std::string& place) : tree_(std::move(tree)), place_(place) {}

  RobotModel make() {
    declareWorld();
    connect();
    std::size_t root = findRoot();
    model_.name = tree_.name;
    model_.warnings = tree_.warnings;
    addRoot(root);

    // Depth first in the file's order, without recursion: a chain may be long.
    std::vector<Step> open;
    push(root, 0, Eigen::Isometry3d::Identity(), open);
    while (!open.empty()) {
      const Step step = open.back();
      open.pop_back();
      add(step, open);
    }
    if (reached_.size() != tree_.links.size())
      throw InputError(place_, lineOfCycle(), "the joints form a cycle; a tree is expected");
    model_.freeBase = model_.links.front().inertial.mass_kg > 0;
    model_.meshesReplacePrimitives = false;
    couple();
    std::ranges::stable_sort(model_.warnings, {}, &Warning::line);
    return std::move(model_);
  }

 private:
  /// A joint to be added below a link of the model; `offset` is the pose of its URDF parent in that link.
  struct Step {
    std::size_t joint;
    int parent;
    Eigen::Isometry3d offset;
  };

  std::size_t linkOf(const std::string& name, const UrdfJoint& joint) const {
    const auto found = tree_.linkNumber.find(name);
    if (found == tree_.linkNumber.end())
      throw InputError(place_, joint.joint.line,
                       "joint " + joint.joint.name + ": there is no link \"" + name.substr(0, 40) + "\"");
    return found->second;
  }

  /// "world" is known to every simulator: a joint may hang from it though no link has that name.
  void declareWorld() {
    if (tree_.linkNumber.contains("world")) return;
    for (const UrdfJoint& joint : tree_.joints)
      if (joint.parent == "world") {
        UrdfLink world;
        world.link.name = "world";
        world.link.line = joint.joint.line;
        tree_.linkNumber.emplace("world", tree_.links.size());
        tree_.links.push_back(std::move(world));
        return;
      }
  }

  void connect() {
    if (tree_.links.empty()) throw InputError(place_ + ": the robot has no links; at least one is expected");
    below_.resize(tree_.links.size());
    parentJoint_.assign(tree_.links.size(), none);
    for (std::size_t i = 0; i < tree_.joints.size(); ++i) {
      const UrdfJoint& joint = tree_.joints[i];
      const std::size_t child = linkOf(joint.child, joint);
      below_[linkOf(joint.parent, joint)].push_back(i);
      if (parentJoint_[child] != none)
        throw InputError(place_, joint.joint.line,
                         "link \"" + joint.child.substr(0, 40) + "\" has a second parent; the first is in line " +
                             std::to_string(tree_.joints[parentJoint_[child]].joint.line));
      parentJoint_[child] = i;
      if (joint.mimic) leads_.insert(joint.mimic->joint);
    }
  }

  std::size_t findRoot() const {
    std::size_t root = none;
    for (std::size_t i = 0; i < tree_.links.size(); ++i) {
      if (parentJoint_[i] != none) continue;
      if (root != none)
        throw InputError(
            place_, tree_.links[i].link.line,
            "a second root link \"" + tree_.links[i].link.name.substr(0, 40) + "\" is not allowed; one is expected");
      root = i;
    }
    if (root == none)
      throw InputError(place_, tree_.links.front().link.line, "the joints form a cycle; one root link is expected");
    return root;
  }

  int lineOfCycle() const {
    for (std::size_t i = 0; i < tree_.links.size(); ++i)
      if (!reached_.count(i)) return tree_.links[i].link.line;
    return 1;
  }

  void addRoot(std::size_t& root) {
    // <link name="world"/> with one floating joint is another way to say that the base is free.
    const UrdfLink& first = tree_.links[root];
    if (!first.hasInertial && below_[root].size() == 1 && tree_.joints[below_[root][0]].floating) {
      reached_.insert(root);
      root = linkOf(tree_.joints[below_[root][0]].child, tree_.joints[below_[root][0]]);
    }
    reached_.insert(root);
    rootIsWorld_ = tree_.links[root].link.name == "world";
    model_.links.push_back(tree_.links[root].link);
  }

  void push(std::size_t link, int parent, const Eigen::Isometry3d& offset, std::vector<Step>& open) const {
    for (auto joint = below_[link].rbegin(); joint != below_[link].rend(); ++joint)
      open.push_back({*joint, parent, offset});
  }

  void add(const Step& step, std::vector<Step>& open) {
    UrdfJoint& source = tree_.joints[step.joint];
    const std::size_t number = linkOf(source.child, source);
    reached_.insert(number);
    UrdfLink& child = tree_.links[number];
    if (source.floating)
      throw InputError(place_, source.joint.line,
                       "joint " + source.joint.name + ": floating is allowed only between an empty root and the base");
    const Eigen::Isometry3d origin = step.offset * source.joint.origin;

    // Frames without mass, and the mass of a base whose root link is only a name, belong to their parent.
    Link& parent = model_.links[static_cast<std::size_t>(step.parent)];
    const bool massForRoot = step.parent == 0 && !rootIsWorld_ && parent.inertial.mass_kg == 0;
    if (source.joint.type == Joint::Type::fixed && (!child.hasInertial || massForRoot)) {
      for (Shape& shape : child.link.shapes) {
        shape.pose = origin * shape.pose;
        parent.shapes.push_back(std::move(shape));
      }
      parent.inertial = combined(parent.inertial, carried(child.link.inertial, origin));
      if (model_.warnings.size() < 200)
        model_.warnings.push_back({child.link.line, "link " + child.link.name + " was joined to " + parent.name +
                                                        ": a fixed part without mass of its own"});
      return push(number, step.parent, origin, open);
    }
    if (isNothing(number)) {
      model_.warnings.push_back({source.joint.line,
                                 "joint " + source.joint.name + " and link " + child.link.name +
                                     " are left out: the joint moves nothing that has a mass or a shape",
                                 Warning::Loss::limits, source.joint.name});
      return;
    }
    jointNumber_[source.joint.name] = static_cast<int>(model_.joints.size());
    sourceOf_.push_back(step.joint);
    source.joint.parentLink = step.parent;
    source.joint.origin = origin;
    model_.joints.push_back(source.joint);
    model_.links.push_back(std::move(child.link));
    push(number, static_cast<int>(model_.links.size()) - 1, Eigen::Isometry3d::Identity(), open);
  }

  /// A link at the end of the tree that moves as nothing more than a place, by a joint that leads no other one.
  bool isNothing(std::size_t number) const {
    const UrdfLink& link = tree_.links[number];
    const UrdfJoint& by = tree_.joints[parentJoint_[number]];
    return by.joint.type != Joint::Type::fixed && !link.hasInertial && link.link.shapes.empty() &&
           below_[number].empty() && !leads_.contains(by.joint.name);
  }

  /// Mimic joints get the joint that really leads them.
  void couple() {
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      const UrdfJoint* at = &tree_.joints[sourceOf_[i]];
      if (!at->mimic) continue;
      Mimic all{0, 1, 0};
      for (std::size_t steps = 0; at->mimic; ++steps) {
        const UrdfMimic& mimic = *at->mimic;
        const auto fail = [&](const std::string& why) {
          throw InputError(place_, mimic.line, "joint " + at->joint.name.substr(0, 40) + " mimics " + why);
        };
        const auto leader = jointNumber_.find(mimic.joint);
        if (leader == jointNumber_.end()) fail("\"" + mimic.joint.substr(0, 40) + "\", which is no joint");
        if (model_.joints[static_cast<std::size_t>(leader->second)].type == Joint::Type::fixed)
          fail("\"" + mimic.joint.substr(0, 40) + "\", which does not move");
        if (steps == tree_.joints.size()) fail("itself, through others");
        all = {leader->second, all.multiplier * mimic.multiplier, all.multiplier * mimic.offset + all.offset};
        at = &tree_.joints[sourceOf_[static_cast<std::size_t>(leader->second)]];
      }
      model_.joints[i].mimic = all;
    }
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  UrdfTree tree_;
  std::string place_;
  RobotModel model_;
  std::vector<std::vector<std::size_t>> below_;  // joints by parent link
  std::vector<std::size_t> parentJoint_;         // by link
  std::unordered_set<std::size_t> reached_;
  std::unordered_set<std::string> leads_;             // joints that others mimic
  std::unordered_map<std::string, int> jointNumber_;  // in the model, by name
  std::vector<std::size_t> sourceOf_;                 // in the file, by joint of the model
  bool rootIsWorld_ = false;
};

}  // namespace

RobotModel makeModel(UrdfTree tree, const std::string& place) { return TreeMaker(std::move(tree), place).make(); }

}  // namespace btr
