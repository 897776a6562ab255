#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/remote/desk.h"
#include "core/remote/games_folder.h"
#include "core/run/setup/evaluator.h"

namespace uchilsim::v1 {
class EvaluateRequest;
class Experiment;
}  // namespace uchilsim::v1

namespace btr::remote {

/// Whole trials of parameter vectors on all cores, with the bits that a run of the same experiment and seed has. Keeps
/// the workers of the experiment that was asked for last.
class EvaluationDesk final : public Desk {
 public:
  static constexpr int mostVectors = 100000;

  /// The first two must outlive it. `database`: "" for none; `jobs` 0: as many as processors.
  EvaluationDesk(const PluginHost& host, const GamesFolder& folder, std::string database, int jobs)
      : host_(host), folder_(folder), database_(std::move(database)), jobs_(jobs) {}

  std::string answer(Method method, std::string_view message) override;

 private:
  void prepare(const uchilsim::v1::Experiment& experiment, Id run);
  std::string describe() const;
  std::string evaluate(const uchilsim::v1::EvaluateRequest& request);

  const PluginHost& host_;
  const GamesFolder& folder_;
  const std::string database_;
  const int jobs_;
  std::string text_;                          ///< the experiment as a file has it
  std::string known_;                         ///< what `prepared_` was made of …
  std::map<std::string, std::string> files_;  ///< … and the files that it was read from, with what they were
  std::unique_ptr<PreparedExperiment> prepared_;
  SimulatorSpec simulator_;
  std::uint64_t seed_ = 0;
  std::unique_ptr<Evaluator> evaluator_;  ///< last: it ends before what it works on
};

}  // namespace btr::remote
