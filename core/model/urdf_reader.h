#pragma once
#include <string>

#include "core/model/load_model.h"

namespace btr {

/// parseUrdf for a text that is the file `path`, from whose folder meshes are looked for. An empty path: there is no
/// file, and no meshes are read.
RobotModel readUrdf(const std::string& text, const std::string& place, const std::string& path,
                    const ModelBudget& budget);

}  // namespace btr
