#pragma once
#include <QString>
#include <string>

namespace btr::ui {
class LiveWorld;

/// Each selected object once more beside itself, at rest, as one step; they are selected then.
void duplicateSelected(LiveWorld& world);

/// The object under another name, at rest where it is: taken away and added again as one step. Returns why not; "" if
/// it was done.
QString renameObject(LiveWorld& world, const std::string& object, const std::string& name);

}  // namespace btr::ui
