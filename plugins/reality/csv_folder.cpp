/// Measured values come as files into a folder, one file a trial:
///   run-R-individual-I-trial-K.csv      K = 1, 2, … of this individual
///   value,void,note                     the columns void (0 or 1) and note may be left out; as MeasuredTable reads it
///   0.41,0,fell at the end
/// What is wanted lies beside it, run-R-individual-I.wanted.csv with the columns parameter,value,unit. A file whose
/// last line has no end is still being written: it is read when the run goes on.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/plugin/measured_table.h"
#include "core/plugin/plugin.h"

namespace {

namespace fs = std::filesystem;

class FolderRobot final : public btr::RealRobot {
 public:
  explicit FolderRobot(const btr::RealityContext& context)
      : folder_(context.texts.at("folder")), genotype_(context.genotype), unit_(context.unit) {
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

  std::optional<btr::RealAnswer> answerIn(const fs::path& file) const {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw btr::InputError(file.string() + ": cannot be read");
    if (text.empty() || text.back() != '\n') return std::nullopt;
    if (text.find_first_not_of("\r\n") == std::string::npos) return std::nullopt;
    std::istringstream lines(text);
    btr::MeasuredTable table(lines, file.string(), unit_, btr::MeasuredTable::Of::oneTrial);
    btr::MeasuredRow row, more;
    if (!table.next(row)) return std::nullopt;
    if (std::abs(row.value) > largest)
      throw btr::InputError(table.atValue(), btr::toText(row.value), "a number from -1e9 to 1e9");
    if (table.next(more))
      throw btr::InputError(file.string() + " line " + std::to_string(table.line()) +
                            ": one trial a file, one line below the columns");
    return btr::RealAnswer{row.value, row.isVoid, row.note};
  }

  static constexpr double largest = 1e9;
  fs::path folder_;
  std::vector<btr::Parameter> genotype_;
  std::string unit_;
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
