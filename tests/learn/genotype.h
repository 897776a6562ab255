#pragma once
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// Parameters between -1 and 1.
inline std::vector<Parameter> genotype(std::size_t count, double start = 0) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i < count; ++i) parameters.push_back({"p" + std::to_string(i), "m", "", -1, 1, start});
  return parameters;
}

}  // namespace btr
