#include "core/openr/stick_parameters.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::openr {
namespace {

namespace fs = std::filesystem;

Parameter parameterFrom(JsonReader& reader) {
  constexpr double most = 1e12;
  Parameter parameter;
  parameter.name = reader.text("name");
  const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  if (parameter.name.empty() || !std::ranges::all_of(parameter.name, allowed))
    reader.refuse("name", "letters, digits and underscores");
  parameter.unit = reader.text("unit", "");
  parameter.meaning = reader.text("meaning", "");
  parameter.minimum = reader.number("min", -most, most);
  parameter.maximum = reader.number("max", -most, most);
  if (!(parameter.maximum > parameter.minimum)) reader.refuse("max", "more than min");
  parameter.byDefault = reader.number("default", parameter.minimum, parameter.maximum);
  parameter.integer = reader.flag("integer", false);
  reader.finish();
  return parameter;
}

}  // namespace

std::vector<Parameter> stickParameters(const std::string& stick) {
  const std::string path = (fs::path(stick) / "parameters.json").string();
  JsonReader reader = JsonReader::parse(readFile(path), path);
  reader.word("format", {"uchilsim-openr-parameters-1"});
  std::vector<Parameter> all;
  reader.array("parameters", [&](JsonReader each) {
    all.push_back(parameterFrom(each));
    if (std::ranges::count(all, all.back().name, &Parameter::name) > 1) each.refuse("name", "each name once");
  });
  if (all.empty()) reader.refuse("parameters", "at least one");
  reader.finish();
  return all;
}

std::string parametersText(std::span<const Parameter> declared, std::span<const double> values) {
  std::string text;
  for (std::size_t i = 0; i < declared.size() && i < values.size(); ++i)
    text += declared[i].name + ' ' + toText(values[i]) + '\n';
  return text;
}

PrivateStick::PrivateStick(const std::string& stick, const std::string& parametersText) {
  std::string pattern = (fs::temp_directory_path() / "uchilsim-stick-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw InputError(pattern, std::strerror(errno), "a folder for temporary files");
  folder_ = pattern;
  std::error_code problem;
  // Links stay links, which the program cannot follow out of its stick.
  fs::copy(stick, folder_, fs::copy_options::recursive | fs::copy_options::copy_symlinks, problem);
  if (problem) {
    std::error_code ignored;  // what is said is why it could not be copied
    fs::remove_all(folder_, ignored);
    throw InputError(stick, problem.message(), "a memory stick that can be copied to " + folder_);
  }
  writeFile((fs::path(folder_) / "PARAMS.TXT").string(), parametersText);
}

PrivateStick::~PrivateStick() {
  std::error_code ignored;  // a temporary folder: nobody can do more about it
  fs::remove_all(folder_, ignored);
}

}  // namespace btr::openr
