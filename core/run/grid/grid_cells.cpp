#include "core/run/grid/grid_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/spec/error.h"

namespace btr {

std::vector<GridCell> cellsOf(const GridSpec& grid) {
  const auto& axes = grid.axes;
  const auto numberOf = [&](const std::array<std::size_t, 3>& index) {
    return static_cast<int>((index[0] * axes[1].size() + index[1]) * axes[2].size() + index[2]) + 1;
  };
  std::vector<GridCell> cells;
  std::array<std::size_t, 3> index{};
  for (index[0] = 0; index[0] < axes[0].size(); ++index[0])
    for (index[1] = 0; index[1] < axes[1].size(); ++index[1])
      for (index[2] = 0; index[2] < axes[2].size(); ++index[2]) {
        GridCell cell;
        cell.number = numberOf(index);
        cell.index = index;
        for (std::size_t axis = 0; axis < 3; ++axis) cell.task[axis] = axes[axis][index[axis]];
        if (grid.mirroredDerived && (cell.task[1] < 0 || (cell.task[1] == 0 && cell.task[2] < 0)))
          cell.mirrorOf = numberOf({index[0], axes[1].size() - 1 - index[1], axes[2].size() - 1 - index[2]});
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<std::size_t, 3> other = index;
          if (index[axis] > 0) {
            --other[axis];
            cell.neighbours.push_back(numberOf(other));
            ++other[axis];
          }
          if (index[axis] + 1 < axes[axis].size()) {
            ++other[axis];
            cell.neighbours.push_back(numberOf(other));
          }
        }
        std::ranges::sort(cell.neighbours);
        cells.push_back(std::move(cell));
      }
  return cells;
}

std::vector<std::vector<int>> wavesOf(const std::vector<GridCell>& cells) {
  const auto cell = [&](int number) -> const GridCell& { return cells[static_cast<std::size_t>(number - 1)]; };
  const auto learner = [&](int number) { return cell(number).mirrorOf ? cell(number).mirrorOf : number; };
  const auto closeness = [](const GridCell& c) {
    return std::tuple(std::abs(c.task[1]), std::abs(c.task[2]), c.task[0], c.number);
  };
  const GridCell* first = nullptr;
  for (const GridCell& c : cells)
    if (c.mirrorOf == 0 && (!first || closeness(c) < closeness(*first))) first = &c;

  // A learning cell touches what its own place and that of its image touch.
  std::vector<std::vector<int>> touched(cells.size() + 1);
  for (const GridCell& c : cells)
    for (const int n : c.neighbours) touched[static_cast<std::size_t>(learner(c.number))].push_back(learner(n));
  std::vector<bool> seen(cells.size() + 1, false);
  std::vector<std::vector<int>> waves;
  std::vector<int> wave{first->number};
  seen[static_cast<std::size_t>(first->number)] = true;
  while (!wave.empty()) {
    std::ranges::sort(wave);
    waves.push_back(wave);
    std::vector<int> next;
    for (const int number : wave)
      for (const int other : touched[static_cast<std::size_t>(number)])
        if (!seen[static_cast<std::size_t>(other)]) {
          seen[static_cast<std::size_t>(other)] = true;
          next.push_back(other);
        }
    wave = std::move(next);
  }
  return waves;
}

Values taskOf(std::span<const double, 3> point) {
  Values task;
  for (std::size_t axis = 0; axis < 3; ++axis) task[GridSpec::axisNames[axis]] = point[axis];
  return task;
}

std::string nameOfTask(std::span<const double, 3> point) {
  const auto degrees = [](double rad) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", rad * 180 / std::numbers::pi + 0.0);
    const std::string plain = text;
    return (plain[0] == '-' ? "−" + plain.substr(1) : plain) + "°";
  };
  return "d " + toText(point[0]) + " m, β " + degrees(point[1]) + ", α " + degrees(point[2]);
}

std::vector<double> mirrorImage(std::span<const Parameter> genotype, std::span<const double> parameters) {
  static constexpr std::array<std::pair<const char*, const char*>, 4> legs{
      {{"_LF_", "_RF_"}, {"_RF_", "_LF_"}, {"_LR_", "_RR_"}, {"_RR_", "_LR_"}}};
  std::vector<double> image(parameters.begin(), parameters.end());
  bool named = false;
  for (std::size_t i = 0; i < genotype.size(); ++i)
    for (const auto& [leg, opposite] : legs) {
      const std::size_t place = genotype[i].name.find(leg);
      if (place == std::string::npos) continue;
      named = true;
      std::string partner = genotype[i].name;
      const Parameter* other = find(genotype, partner.replace(place, 4, opposite));
      if (!other || other->minimum != genotype[i].minimum || other->maximum != genotype[i].maximum)
        throw InputError("mirror image", genotype[i].name, "a parameter with a partner " + partner + " of its range");
      image[static_cast<std::size_t>(other - genotype.data())] = parameters[i];
    }
  if (!named)
    throw InputError("mirror image", "a controller without parameters named after legs",
                     "one like kick, whose left and right legs can change places");
  return image;
}

}  // namespace btr
