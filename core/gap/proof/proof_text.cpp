// The proof's tables, once for a terminal and once as a page.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

#include "core/gap/proof/proof_text.h"
#include "core/gap/replay/svg.h"

namespace btr {
namespace {

struct Table {
  std::string title, note;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

std::string formatted(double value, const char* format) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string hitsText(const Share& share) {
  if (share.cases == 0) return "-";
  return std::to_string(share.hits) + "/" + std::to_string(share.cases);
}

std::string withInterval(const Share& share) {
  if (share.cases == 0) return "-";
  return hitsText(share) + " = " + formatted(100 * share.value(), "%.1f") + " % (" +
         formatted(100 * share.low(), "%.1f") + " to " + formatted(100 * share.high(), "%.1f") + ")";
}

Table barTable(const ProofScore& score) {
  Table table{"Bars", "Shares with their 95 % intervals.", {"question", "wanted", "found", ""}, {}};
  for (const ProofBar& bar : score.bars)
    table.rows.push_back({bar.question, bar.wanted, bar.found, !bar.asked ? "not asked" : bar.met ? "met" : "NOT MET"});
  return table;
}

Table otherTable(const ProofGroup& all) {
  return {"Beside the bars",
          "",
          {"what", "value"},
          {{"one effect named, and nothing else accepted", withInterval(all.alone)},
           {"an effect from outside is called unexplained", withInterval(all.unexplained)},
           {"numbers changed without need (nothing was wrong)", withInterval(all.numbersChanged)},
           {"sizes of named effects within their 95 % interval", withInterval(all.parametersCovered)},
           {"calibrated numbers within theirs, verdict right", withInterval(all.calibratedCovered)},
           {"sizes within their interval among rivals", withInterval(all.parametersAmongRivals)},
           {"calibrated numbers within theirs", withInterval(all.calibratedAmongRivals)},
           {"error in fresh recordings over noise, median", formatted(middleOf(all.heldOut), "%.3f")},
           {"calibrated numbers, median error", formatted(100 * middleOf(all.calibratedErrors), "%.2f %%")},
           {"analyses that failed", std::to_string(all.failed) + " of " + std::to_string(all.cases)},
           {"time of an analysis, median", formatted(middleOf(all.seconds), "%.1f s")}}};
}

Share together(const Share& a, const Share& b) { return {a.hits + b.hits, a.cases + b.cases}; }

Table groupTable(const std::string& title, const std::vector<std::pair<std::string, ProofGroup>>& groups) {
  Table table{
      title,
      "Hits of cases. Named, place, both: effects above three noise floors. Fresh: error in recordings that the "
      "analysis was never given. Changed: numbers, where nothing was wrong. In interval, among rivals: of numbers, not "
      "cases.",
      {"", "cases", "false alarms", "named", "alone", "both", "place", "fresh ok", "outside wrong", "changed",
       "in interval", "among rivals", "error/noise", "parameters", "seconds"},
      {}};
  for (const auto& [name, group] : groups)
    table.rows.push_back({name, std::to_string(group.cases), hitsText(group.falseAlarms), hitsText(group.named),
                          hitsText(group.alone), hitsText(group.bothNamed), hitsText(group.location),
                          hitsText(group.heldOutNear), hitsText(group.confidentlyWrong), hitsText(group.numbersChanged),
                          hitsText(together(group.parametersCovered, group.calibratedCovered)),
                          hitsText(together(group.parametersAmongRivals, group.calibratedAmongRivals)),
                          formatted(middleOf(group.heldOut), "%.3f"),
                          formatted(100 * middleOf(group.parameterErrors), "%.1f %%"),
                          formatted(middleOf(group.seconds), "%.1f")});
  return table;
}

/// A table of how often each pair was seen.
Table countTable(const std::string& title, const std::string& note, const std::string& corner,
                 const std::map<std::pair<std::string, std::string>, int>& counts) {
  std::set<std::string> rows, columns;
  for (const auto& [pair, count] : counts) {
    rows.insert(pair.first);
    columns.insert(pair.second);
  }
  Table table{title, note, {corner}, {}};
  table.header.insert(table.header.end(), columns.begin(), columns.end());
  for (const std::string& row : rows) {
    table.rows.push_back({row});
    for (const std::string& column : columns) {
      const auto found = counts.find({row, column});
      table.rows.back().push_back(found == counts.end() ? "" : std::to_string(found->second));
    }
  }
  return table;
}

Table verdictTable(const ProofScore& score) {
  return countTable("Kind of case (rows) and verdict (columns)",
                    "Right: nothing – no_mismatch, parameters – parameters_suffice, one and two – missing_physics, "
                    "outside – unexplained.",
                    "kind", score.verdicts);
}

Table confusionTable(const ProofScore& score) {
  return countTable("What was hidden (rows) and what was named (columns)",
                    "Effects above three noise floors, and the cases with nothing missing. \"(rival)\": among at most "
                    "two rivals of what was accepted. In brackets: the verdict where no effect was accepted.",
                    "hidden", score.confusion);
}

std::vector<Table> tablesOf(const ProofScore& score) {
  return {barTable(score),
          otherTable(score.all),
          groupTable("By scene", score.byScene),
          groupTable("By kind of case", score.byKind),
          groupTable("By cost of leaving the effect out [noise floors]", score.byCost),
          verdictTable(score),
          confusionTable(score)};
}

/// Characters, not bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void writeText(std::ostream& out, const Table& table) {
  out << table.title << "\n";
  if (!table.note.empty()) out << table.note << "\n";
  std::vector<std::size_t> widths;
  for (const auto& cell : table.header) widths.push_back(width(cell));
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) text += cells[i] + std::string(widths[i] - width(cells[i]) + 2, ' ');
    out << text.substr(0, text.find_last_not_of(' ') + 1) << "\n";
  };
  line(table.header);
  for (const auto& row : table.rows) line(row);
  out << "\n";
}

void writeHtml(std::ostream& out, const Table& table) {
  out << "<h2>" << svg::escaped(table.title) << "</h2>\n";
  if (!table.note.empty()) out << "<p>" << svg::escaped(table.note) << "</p>\n";
  out << "<table><tr>";
  for (const auto& cell : table.header) out << "<th>" << svg::escaped(cell) << "</th>";
  out << "</tr>\n";
  for (const auto& row : table.rows) {
    out << "<tr>";
    for (const auto& cell : row) {
      const std::string kind = cell == "met" ? " class=\"met\"" : cell == "NOT MET" ? " class=\"missed\"" : "";
      out << "<td" << kind << ">" << svg::escaped(cell) << "</td>";
    }
    out << "</tr>\n";
  }
  out << "</table>\n";
}

}  // namespace

std::string proofText(const ProofScore& score) {
  std::ostringstream out;
  for (const Table& table : tablesOf(score)) writeText(out, table);
  return out.str();
}

std::string proofHtml(const ProofScore& score) {
  std::ostringstream out;
  out << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Blind trial of gap analysis</title>\n"
         "<style>body{font:14px sans-serif;margin:2em;max-width:80em}table{border-collapse:collapse}"
         "td,th{border:1px solid #bbb;padding:3px 7px;text-align:left}th{background:#eee}"
         ".met{background:#d8f0d8}.missed{background:#f6d5d5;font-weight:bold}</style></head><body>\n"
         "<h1>Blind trial of gap analysis</h1>\n";
  for (const Table& table : tablesOf(score)) writeHtml(out, table);
  out << "</body></html>\n";
  return out.str();
}

}  // namespace btr
