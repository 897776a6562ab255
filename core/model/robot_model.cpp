#include "core/model/robot_model.h"

namespace btr {
namespace {

template <class Named>
int indexOf(const std::vector<Named>& all, const std::string& name) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

int RobotModel::findLink(const std::string& link) const { return indexOf(links, link); }
int RobotModel::findJoint(const std::string& joint) const { return indexOf(joints, joint); }

}  // namespace btr
