#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/spec/json_reader.h"
#include "core/spec/parameter.h"

namespace btr::cli {

const PluginHost& Shell::plugins() {
  if (!plugins_) {
    plugins_ = std::make_unique<PluginHost>(PluginHost::searchPath());
    for (const std::string& problem : plugins_->problems()) std::fprintf(stderr, "btr: %s\n", problem.c_str());
  }
  return *plugins_;
}

void printJson(const nlohmann::json& document) {
  std::cout << document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

bool closeOutput() {
  // Both streams end in the same file, which remembers that something went wrong.
  std::cout.flush();
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "btr: standard output: cannot be written%s\n",
               errno ? (std::string(" (") + std::strerror(errno) + ")").c_str() : "");
  return false;
}

void writeOut(const std::string& path, const std::string& text) {
  if (path.empty())
    std::fwrite(text.data(), 1, text.size(), stdout);
  else
    writeFile(path, text);
}

std::string interval(const Spread& spread) {
  if (spread.count == 0) return "";
  char text[48];
  std::snprintf(text, sizeof text, spread.count > 1 ? "%.3f ± %.3f" : "%.3f", spread.mean, spread.halfWidth95);
  return text;
}

namespace {

// Columns on the screen: bytes that do not continue a UTF-8 character.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string printable(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\x%02x", byte);
    if (c == '\n')
      shown += "\\n";
    else if (byte < 0x20 || byte == 0x7F)
      shown += escape;
    else
      shown += c;
  }
  return shown;
}

std::string table(const std::vector<std::string>& header, std::vector<std::vector<std::string>> rows) {
  for (auto& row : rows)
    for (std::string& cell : row) cell = printable(cell);
  std::vector<std::size_t> widths;
  for (const std::string& h : header) widths.push_back(width(h));
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells, bool numbersRight) {
    std::string out;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string pad(widths[c] - width(cells[c]), ' ');
      const bool right = numbersRight && toNumber(cells[c]).has_value();
      out += (c ? "  " : "") + (right ? pad + cells[c] : cells[c] + pad);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    text += out + '\n';
  };
  line(header, false);
  for (const auto& row : rows) line(row, true);
  return text;
}

}  // namespace btr::cli
