#include "core/run/export.h"

#include <cctype>
#include <map>
#include <set>

#include "core/run/reality/reality_gap.h"
#include "core/run/reality/reality_report.h"
#include "core/spec/csv.h"
#include "core/spec/error.h"

namespace btr {
namespace {

/// Cells joined to lines.
class Table {
 public:
  Table& operator<<(const std::string& text) {
    if (!lineBegins_) text_ += ',';
    lineBegins_ = false;
    text_ += csvField(text);
    return *this;
  }
  Table& operator<<(const char* text) { return *this << std::string(text); }
  Table& operator<<(double number) { return *this << toText(number); }
  Table& operator<<(const std::optional<double>& number) { return *this << (number ? toText(*number) : std::string()); }
  Table& operator<<(int number) { return *this << std::to_string(number); }
  Table& operator<<(Id number) { return *this << std::to_string(number); }
  Table& operator<<(std::uint64_t number) { return *this << std::to_string(number); }
  void endLine() {
    text_ += '\n';
    lineBegins_ = true;
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
  bool lineBegins_ = true;
};

void head(Table& table, std::initializer_list<std::string> names) {
  for (const std::string& name : names) table << name;
}

// Users know simulators by their version number in the run.
std::map<Id, int> versionNumbers(const Database& database, Id run) {
  std::map<Id, int> numbers;
  for (const SimulatorRecord& s : database.simulators(run)) numbers[s.id] = s.number;
  return numbers;
}

std::string generations(const Database& database, const RunRecord& run, const std::string& unit) {
  Table table;
  head(table, {"run", "generation", "simulator", "best" + unit, "mean" + unit, "worst" + unit, "trials", "reused",
               "failed", "wall_time_s", "finished_at", "reality"});
  table.endLine();
  const std::map<Id, int> versions = versionNumbers(database, run.id);
  for (const GenerationRecord& g : database.generations(run.id)) {
    table << run.id << g.number << versions.at(g.simulator) << g.best << g.mean << g.worst << g.trials << g.reused
          << g.failed << g.seconds << g.finishedAt << run.reality;
    table.endLine();
  }
  return std::move(table).text();
}

// Values that count, by individual.
struct Measured {
  int count = 0;
  double sum = 0;
  std::set<std::string> sources;
};

std::string individuals(const Database& database, const RunRecord& run, std::span<const Parameter> names,
                        const std::string& unit) {
  const std::vector<IndividualRecord> all = database.individuals(run.id);
  const std::size_t parameters = all.empty() ? names.size() : all.front().parameters.size();
  if (!names.empty() && names.size() != parameters)
    throw InputError(database.path() + " run " + std::to_string(run.id) + ": " + std::to_string(names.size()) +
                     " names for " + std::to_string(parameters) + " parameters");
  Table table;
  head(table, {"run", "individual", "generation", "slot", "simulator", "fitness" + unit, "outcome", "detail", "same_as",
               "trial_seed", "trace_sha256", "measured_mean" + unit, "measured_count", "reality", "chromosome"});
  for (std::size_t k = 0; k < parameters; ++k)
    table << (names.empty() ? "parameter_" + std::to_string(k + 1) : names[k].name);
  table.endLine();

  std::map<Id, Measured> measured;
  for (const MeasurementRecord& m : database.measurements(run.id)) {
    if (m.isVoid) continue;
    Measured& values = measured[m.individual];
    ++values.count;
    values.sum += m.value;
    values.sources.insert(m.source);
  }
  const std::map<Id, int> versions = versionNumbers(database, run.id);
  for (const IndividualRecord& i : all) {
    table << run.id << i.id << i.generation << i.slot << versions.at(i.simulator) << i.fitness << i.outcome << i.detail
          << (i.sameAs ? std::to_string(i.sameAs) : "") << i.trialSeed << i.traceSha256;
    if (const auto found = measured.find(i.id); found != measured.end()) {
      std::string reality;
      for (const std::string& source : found->second.sources) reality += (reality.empty() ? "" : "+") + source;
      table << found->second.sum / found->second.count << found->second.count << reality;
    } else {
      table << "" << 0 << "";
    }
    table << i.chromosome;
    if (i.parameters.size() != parameters)
      throw InputError(database.path() + " individual " + std::to_string(i.id) + ": " +
                       std::to_string(i.parameters.size()) + " parameters where others have " +
                       std::to_string(parameters));
    for (const double value : i.parameters) table << value;
    table.endLine();
  }
  return std::move(table).text();
}

std::string gaps(const Database& database, const RunRecord& run, const std::string& unit) {
  Table table;
  head(table,
       {"run", "stage", "simulator_before", "simulator_after", "before" + unit, "after" + unit,
        "held_out_before" + unit, "held_out_after" + unit, "new_before" + unit, "new_after" + unit,
        "standard_error" + unit, "individuals", "held_out_standard_error" + unit, "held_out_individuals", "reality"});
  table.endLine();
  const std::map<Id, int> versions = versionNumbers(database, run.id);
  for (const GapRecord& g : database.gaps(run.id)) {
    table << run.id << g.stage << versions.at(g.simulatorBefore) << versions.at(g.simulatorAfter) << g.before << g.after
          << g.heldOutBefore << g.heldOutAfter << g.newBefore << g.newAfter << g.standardError << g.individuals
          << (g.heldOutBefore ? std::optional(g.heldOutStandardError) : std::nullopt) << g.heldOutIndividuals
          << run.reality;
    table.endLine();
  }
  return std::move(table).text();
}

// All numbers of a version by column: values, then "EFFECT@PLACE.PARAMETER"; a second effect of that name and place is
// #2.
std::map<std::string, double> numbersOf(const SimulatorSpec& simulator) {
  std::map<std::string, double> numbers(simulator.values.begin(), simulator.values.end());
  std::map<std::string, int> seen;
  for (const PlacedEffect& e : simulator.effects) {
    std::string name = e.effect + "@" + e.at;
    if (const int count = ++seen[name]; count > 1) name += "#" + std::to_string(count);
    for (const auto& [parameter, value] : e.parameters) numbers[name + "." + parameter] = value;
  }
  return numbers;
}

std::string simulators(const Database& database, const RunRecord& run) {
  const std::vector<SimulatorRecord> all = database.simulators(run.id);
  const std::map<Id, int> versions = versionNumbers(database, run.id);
  std::set<std::string> columns;
  for (const SimulatorRecord& s : all)
    for (const auto& [name, value] : numbersOf(s.simulator)) columns.insert(name);
  Table table;
  head(table, {"run", "simulator", "parent", "made_by", "made_after_generation", "created_at", "effects", "reality"});
  for (const std::string& column : columns) table << column;
  table.endLine();
  for (const SimulatorRecord& s : all) {
    std::string effects;
    for (const PlacedEffect& e : s.simulator.effects) effects += (effects.empty() ? "" : " ") + e.effect + "@" + e.at;
    table << run.id << s.number << (s.parent ? std::to_string(versions.at(s.parent)) : "") << s.madeBy
          << s.madeAfterGeneration << s.createdAt << effects << run.reality;
    const std::map<std::string, double> numbers = numbersOf(s.simulator);
    for (const std::string& column : columns) {
      const auto found = numbers.find(column);
      table << (found == numbers.end() ? std::optional<double>() : found->second);
    }
    table.endLine();
  }
  return std::move(table).text();
}

std::string measurements(const Database& database, const RunRecord& run, const std::string& unit,
                         const std::string& fitnessUnit) {
  Table table;
  head(table, {"run", "measurement", "individual", "generation", "slot", "stage", "held_out", "reason", "rank",
               "disagreement" + unit, "candidates", "simulated_fitness" + unit, "value" + unit, "void", "note", "who",
               "entered_at", "reality"});
  table.endLine();
  // An individual that was asked for twice is shown with the stage that asked first.
  std::map<Id, MeasurementTask> tasks;
  for (const MeasurementTask& task : database.measurementTasks(run.id)) tasks.emplace(task.individual, task);
  for (const MeasurementRecord& m : database.measurements(run.id)) {
    const IndividualRecord individual = database.individual(m.individual);
    const MeasurementTask& task = tasks.at(m.individual);
    table << run.id << m.id << m.individual << individual.generation << individual.slot << task.stage
          << int{task.heldOut} << reasonOf(task, fitnessUnit, true) << task.rank << task.disagreement << task.candidates
          << task.simulatedFitness << m.value << int{m.isVoid} << m.note << m.who << m.enteredAt << m.source;
    table.endLine();
  }
  return std::move(table).text();
}

// Policies of L2 with the change of each parameter: −1, 0 or 1, nothing where there is no centre.
std::string policies(const Database& database, const RunRecord& run, std::span<const Parameter> genotype,
                     const std::string& unit) {
  Table table;
  head(table, {"run", "stage", "iteration", "individual", "simulated_fitness" + unit, "measured_mean" + unit,
               "standard_error" + unit, "measured_count", "reality"});
  for (const Parameter& p : genotype) table << p.name;
  for (const Parameter& p : genotype) table << "change_" + p.name;
  table.endLine();
  for (const RealityReport& report : realityReports(database, run, genotype))
    for (const PolicyRow& p : report.policies) {
      table << run.id << report.stage << report.number << p.individual << p.simulated << p.fitness << p.standardError
            << p.count << run.reality;
      for (const double value : p.parameters) table << value;
      for (std::size_t n = 0; n < genotype.size(); ++n) {
        if (n < p.changes.size())
          table << p.changes[n];
        else
          table << "";
      }
      table.endLine();
    }
  return std::move(table).text();
}

// One line for each parameter and iteration of L2.
std::string steps(const Database& database, const RunRecord& run, std::span<const Parameter> genotype,
                  const std::string& unit) {
  Table table;
  head(table, {"run", "stage", "iteration", "parameter", "unit", "centre_before"});
  for (const std::string group : {"below", "same", "above"})
    for (const std::string what : {"_count", "_mean", "_standard_error"})
      table << group + what + (what == "_count" ? "" : unit);
  for (const char* name : {"gradient", "p_value", "significant", "step", "centre_after", "reality"}) table << name;
  table.endLine();
  for (const RealityReport& report : realityReports(database, run, genotype))
    for (const StepRow& s : report.steps) {
      table << run.id << report.stage << report.number << s.parameter.name << s.parameter.unit << s.centreBefore;
      for (const PolicyGroup* group : {&s.gradient.below, &s.gradient.same, &s.gradient.above})
        table << group->count << (group->count > 0 ? std::optional(group->mean) : std::nullopt)
              << (group->count > 1 ? std::optional(group->standardError) : std::nullopt);
      table << s.gradient.gradient << s.gradient.pValue
            << (s.gradient.pValue ? std::optional<double>(s.isSignificant()) : std::nullopt)
            << (s.centreAfter ? std::optional(s.gradient.step) : std::nullopt) << s.centreAfter << run.reality;
      table.endLine();
    }
  return std::move(table).text();
}

}  // namespace

std::string unitSuffix(const std::string& unit) {
  std::string suffix;
  for (const char c : unit) {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      suffix += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (c == '/' || c == ' ') {
      suffix += '_';
    }
  }
  return suffix.empty() ? "" : "_" + suffix;
}

std::string exportCsv(const Database& database, Id id, const std::string& what, const std::vector<Parameter>& genotype,
                      const std::string& fitnessUnit) {
  const RunRecord run = database.run(id);
  const std::string unit = unitSuffix(fitnessUnit);
  if (what == "generations") return generations(database, run, unit);
  if (what == "individuals") return individuals(database, run, genotype, unit);
  if (what == "gaps") return gaps(database, run, unit);
  if (what == "simulators") return simulators(database, run);
  if (what == "measurements") return measurements(database, run, unit, fitnessUnit);
  if (what == "policies") return policies(database, run, genotype, unit);
  if (what == "steps") return steps(database, run, genotype, unit);
  throw InputError("export", '"' + what + '"',
                   "generations, individuals, gaps, simulators, measurements, policies or steps");
}

}  // namespace btr
