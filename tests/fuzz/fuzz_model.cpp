// Both robot readers on any bytes. The first byte chooses the reader, the rest is the file. What is read is also
// described, so that the later stages see it too. Anything but a model or an InputError is a finding.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/model/load_model.h"
#include "core/spec/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  btr::ModelBudget budget;
  budget.bytes = 64 * 1024;
  budget.nodes = 2000;
  budget.values = 20'000;
  budget.depth = 60;
  budget.triangles = 5000;
  budget.text = 1000;
  budget.identifier = 200;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const btr::RobotModel model =
        data[0] % 2 ? btr::parseUrdf(text, "fuzz.urdf", budget) : btr::parseVrml(text, "fuzz.wrl", budget);
    btr::describeModel(model);
  } catch (const btr::InputError&) {
  }
  return 0;
}
