#include "app/bench/btr_bench_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "app/btr_commands.h"
#include "core/sim/worker_pool.h"

namespace btr::cli {
namespace {

std::string figure(const BenchRow& row) {
  if (std::isnan(row.value)) return "–";
  char text[48];
  std::snprintf(text, sizeof text, std::abs(row.value) >= 1000 ? "%.0f" : "%.3g", row.value);
  return text;
}

std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string benchRowsTable(const std::vector<BenchRow>& rows) {
  std::vector<std::array<std::string, 7>> cells{{"part", "what", "figure", "unit", "step", "accuracy", "note"}};
  for (const BenchRow& row : rows)
    cells.push_back({row.part, row.what, figure(row), row.unit, row.step, row.exact, row.note});
  std::array<std::size_t, 7> width{};
  for (const auto& line : cells)
    for (std::size_t k = 0; k < width.size(); ++k) width[k] = std::max(width[k], columns(line[k]));
  std::string table;
  for (const auto& line : cells) {
    std::string text;
    for (std::size_t k = 0; k < width.size(); ++k) {
      const std::string gap(width[k] - columns(line[k]), ' ');
      text += k == 2 ? gap + line[k] : line[k] + gap;
      text += "  ";
    }
    table += text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
  }
  return table;
}

nlohmann::json toJson(const BenchRow& row) {
  nlohmann::json value = std::isnan(row.value) ? nlohmann::json() : nlohmann::json(row.value);
  return {{"part", row.part}, {"what", row.what},      {"value", value},  {"unit", row.unit},
          {"step", row.step}, {"accuracy", row.exact}, {"note", row.note}};
}

nlohmann::json benchMachine() {
  std::string processor = "unknown";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  double load = 0;
  if (getloadavg(&load, 1) != 1) load = NAN;
  return {{"processor", processor}, {"processors", processorCount()}, {"load", load}};
}

}  // namespace btr::cli
