/// Measured values come as files into a folder, one file a trial:
///   run-R-individual-I-trial-K.csv      K = 1, 2, … of this individual
///   value,void,note                     the columns void (0 or 1) and note may be left out
///   0.41,0,fell at the end
/// What is wanted lies beside it, run-R-individual-I.wanted.csv with the columns parameter,value,unit. A file whose
/// last line has no end is still being written: it is read when the run goes on.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "core/plugin/plugin.h"

namespace {

namespace fs = std::filesystem;

class FolderRobot final : public btr::RealRobot {
 public:
  explicit FolderRobot(const btr::RealityContext& context)
      : folder_(context.texts.at("folder")), genotype_(context.genotype) {
    if (!fs::is_directory(folder_)) throw btr::InputError("reality csv_folder", folder_.string(), "a folder");
  }

  std::optional<btr::RealAnswer> measure(const btr::RealTask& task) override {
    const std::string name = "run-" + std::to_string(task.run) + "-individual-" + std::to_string(task.individual);
    const fs::path file = folder_ / (name + "-trial-" + std::to_string(task.trial + 1) + ".csv");
    if (fs::is_regular_file(file)) return answerIn(file);
    if (const fs::path wanted = folder_ / (name + ".wanted.csv"); !fs::exists(wanted)) {
      std::ofstream stream(wanted, std::ios::binary);
      stream << wantedText(task);
      if (!stream.flush()) throw btr::InputError(wanted.string() + ": cannot be written");
    }
    return std::nullopt;
  }

 private:
  std::string wantedText(const btr::RealTask& task) const {
    std::string text = "parameter,value,unit\n";
    for (std::size_t i = 0; i < genotype_.size(); ++i)
      text += genotype_[i].name + "," + btr::toText(task.parameters[i]) + "," + genotype_[i].unit + "\n";
    return text;
  }

  static std::optional<btr::RealAnswer> answerIn(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw btr::InputError(file.string() + ": cannot be read");
    if (text.empty() || text.back() != '\n') return std::nullopt;
    std::istringstream lines(text);
    btr::CsvReader table(lines, file.string());
    std::vector<std::string> header, row, more;
    if (!table.next(header) || !table.next(row)) return std::nullopt;
    if (row.size() != header.size())
      throw btr::InputError(table.at() + ": " + std::to_string(row.size()) + " fields; " +
                            std::to_string(header.size()) + " as the columns");
    std::map<std::string, std::string> cells;
    for (std::size_t c = 0; c < header.size(); ++c) {
      const bool known = header[c] == "value" || header[c] == "void" || header[c] == "note";
      if (!known || !cells.emplace(header[c], row[c]).second)
        throw btr::InputError(file.string(), "the column \"" + header[c] + "\"", "value, void and note, each once");
    }
    if (!cells.contains("value")) throw btr::InputError(file.string() + ": the column value is missing");
    const std::string place = table.at();
    if (table.next(more)) throw btr::InputError(table.at() + ": one trial a file, one line below the columns");
    const std::string &marked = cells["void"], &value = cells["value"];
    if (!marked.empty() && marked != "0" && marked != "1")
      throw btr::InputError(place + " void", "\"" + marked + "\"", "0 or 1");
    btr::RealAnswer answer{0, marked == "1", cells["note"]};
    if (value.empty() && answer.isVoid) return answer;
    const auto number = btr::toNumber(value);
    if (!number || std::abs(*number) > 1e9)
      throw btr::InputError(place + " value", "\"" + value + "\"", "a number from -1e9 to 1e9");
    answer.fitness = *number;
    return answer;
  }

  fs::path folder_;
  std::vector<btr::Parameter> genotype_;
};

class CsvFolder final : public btr::Reality {
  std::string meaning() const override { return "Measured values come as CSV files into a folder"; }
  std::vector<btr::TextSetting> texts() const override {
    return {
        {"folder", "where requests are written and measured values are looked for", btr::TextSetting::Kind::folder}};
  }
  std::string who() const override { return "csv_folder"; }
  std::unique_ptr<btr::RealRobot> open(const btr::RealityContext& context) const override {
    return std::make_unique<FolderRobot>(context);
  }
};

}  // namespace

BTR_REALITY(CsvFolder, "csv_folder")
