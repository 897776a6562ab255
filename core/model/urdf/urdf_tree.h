#pragma once
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/model/load_model.h"

namespace btr {

/// What stands in a URDF file, link by link and joint by joint, before it is a tree.
struct UrdfLink {
  Link link;
  bool hasInertial = false;  ///< with a mass above 0
};

struct UrdfMimic {
  std::string joint;
  double multiplier = 1, offset = 0;
  int line = 0;
};

struct UrdfJoint {
  Joint joint;
  std::string parent, child;
  std::optional<UrdfMimic> mimic;
  bool floating = false;
};

struct UrdfTree {
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::unordered_map<std::string, std::size_t> linkNumber;
  std::vector<Warning> warnings;
  std::map<std::string, int> effortless;  ///< moving joints of effort 0, each with its line
};

/// Orders links and joints from the root on. Links without mass that are fixed to another one (frames, covers) are
/// joined to it. A root without mass is a place in the world: the base is fixed. A floating joint below such a root
/// frees the base. A parent "world" that the file does not declare is such a root. A joint that mimics a mimicking one
/// follows that one's leader. Throws InputError for unknown or several parents, several roots, cycles, and leaders that
/// do not exist or do not move.
RobotModel makeModel(UrdfTree tree, const std::string& place);

}  // namespace btr
