#pragma once
#include <string>
#include <vector>

#include "core/store/records.h"

namespace btr {

/// Finds the bounds of genes from chromosomes and the parameters that were decoded from them, for runs that were stored
/// before bounds were. What it finds is proven: every pair that it was shown decodes to the same bits.
class GeneBoundsFinder {
 public:
  GeneBoundsFinder();
  ~GeneBoundsFinder();
  void show(const std::string& chromosome, const std::vector<double>& parameters);
  /// Empty where there are none, or where they cannot be told from what was shown.
  std::vector<GeneBounds> bounds() const;

 private:
  struct Genes;
  std::vector<Genes> codings_;  ///< binary and Gray, as long as they fit
  std::size_t length_ = 0, parameters_ = 0;
  bool fits_ = true;
};

}  // namespace btr
