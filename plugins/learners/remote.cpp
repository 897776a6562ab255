/// The learner is another program: whoever is connected to the run through the open interface (btr serve) gives the
/// populations and is told their fitness. This plugin asks on the descriptor that $UCHILSIM_LEARNER names, one JSON
/// object a line:
///   → {"ask": 3, "parameters": [{"name": …, "unit": …, "meaning": …, "minimum": …, "maximum": …, "default": …}, …],
///      "population": 0, "start": […], "told": {"vectors": [[…], …], "fitness": […]}, "state": "…"}
///   ← {"vectors": [[…], …], "state": "…"}     the next population, and what the learner needs to go on from it
///   → {"taken": 3} or {"refused": "why"}      after which another answer is waited for
///   ← {"end": "why"}                          instead of an answer: the run stops, and goes on from the database
/// The state is the learner's own text. It is stored with each generation, so that a learner which begins anew is given
/// its text and what came of the vectors that it belongs to, and goes on as if nothing had happened.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin.h"

namespace {

using nlohmann::json;
using Vectors = std::vector<std::vector<double>>;

constexpr std::size_t mostVectors = 10000, longestState = 1u << 20, longestLine = 64u << 20;

/// Lines to and from whoever asks the learner.
class Line {
 public:
  Line() {
    const char* named = std::getenv("UCHILSIM_LEARNER");
    const auto number = btr::toNumber(named ? named : "");
    if (!number || *number < 0 || *number > 1e6)
      throw btr::InputError(
          "learner remote: nobody is connected; another program is the learner of a run that btr serve "
          "works on");
    descriptor_ = static_cast<int>(*number);
  }

  void say(const json& object) {
    const std::string line = object.dump() + "\n";
    for (std::size_t at = 0; at < line.size();) {
      const ssize_t n = ::write(descriptor_, line.data() + at, line.size() - at);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) gone();
      at += static_cast<std::size_t>(n);
    }
  }

  std::string hear() {
    std::size_t end;
    while ((end = pending_.find('\n')) == std::string::npos) {
      char bytes[65536];
      const ssize_t n = ::read(descriptor_, bytes, sizeof bytes);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0 || pending_.size() > longestLine) gone();
      pending_.append(bytes, static_cast<std::size_t>(n));
    }
    std::string line = pending_.substr(0, end);
    pending_.erase(0, end + 1);
    return line;
  }

 private:
  [[noreturn]] static void gone() { throw btr::InputError("learner remote: the connection to it has ended"); }

  int descriptor_;
  std::string pending_;
};

class Remote final : public btr::Learner {
 public:
  std::vector<btr::Parameter> settings() const override {
    return {{"population",
             "",
             "vectors of a generation; 0: as many as the other program gives",
             0,
             static_cast<double>(mostVectors),
             0,
             {},
             true}};
  }

  void start(std::vector<btr::Parameter> genotype, const btr::Values& values, btr::Random&) override {
    population_ = static_cast<std::size_t>(btr::resolve(settings(), values, "remote").front());
    genotype_ = std::move(genotype);
    number_ = 0;
    start_.clear();
    pending_.clear();
    told_ = {};
    fitness_.clear();
    text_.clear();
  }

  void beginAt(std::span<const double> at, const btr::Permutations&, btr::Random&) override {
    start_.assign(at.begin(), at.end());
  }

  std::vector<btr::Candidate> ask(btr::Random&) override {
    if (pending_.empty()) askOutside();
    std::vector<btr::Candidate> candidates;
    for (const std::vector<double>& vector : pending_) candidates.push_back({"", vector});
    return candidates;
  }

  void tell(std::span<const double> fitness) override {
    double worst = std::numeric_limits<double>::infinity();
    for (const double each : fitness)
      if (std::isfinite(each)) worst = std::min(worst, each);
    if (!std::isfinite(worst)) worst = 0;
    fitness_.clear();
    for (const double each : fitness) fitness_.push_back(std::isfinite(each) ? each : worst);
    told_ = std::move(pending_);
    pending_.clear();
  }

  std::string state() const override {
    return json{{"number", number_}, {"start", start_},     {"pending", pending_},
                {"told", told_},     {"fitness", fitness_}, {"text", text_}}
        .dump();
  }

  void setState(const std::string& state) override {
    const json all = json::parse(state);
    number_ = all.at("number").get<long>();
    start_ = all.at("start").get<std::vector<double>>();
    pending_ = all.at("pending").get<Vectors>();
    told_ = all.at("told").get<Vectors>();
    fitness_ = all.at("fitness").get<std::vector<double>>();
    text_ = all.at("text").get<std::string>();
  }

 private:
  void askOutside() {
    // Made when it is first needed: a learner that only lists its settings has nobody to talk to.
    if (!line_) line_ = std::make_unique<Line>();
    line_->say(question());
    while (true) {
      const std::string answer = line_->hear();
      try {
        take(json::parse(answer));
        break;
      } catch (const json::exception&) {
        line_->say({{"refused", "learner remote: an answer that is no JSON object with vectors"}});
      } catch (const Refused& refused) {
        line_->say({{"refused", refused.what()}});
      }
    }
    ++number_;
    line_->say({{"taken", number_}});
  }

  struct Refused : btr::InputError {
    using btr::InputError::InputError;
  };

  json question() const {
    json parameters = json::array();
    for (const btr::Parameter& p : genotype_)
      parameters.push_back({{"name", p.name},
                            {"unit", p.unit},
                            {"meaning", p.meaning},
                            {"minimum", p.minimum},
                            {"maximum", p.maximum},
                            {"default", p.byDefault},
                            {"integer", p.integer},
                            {"choices", p.choices}});
    return {{"ask", number_ + 1},
            {"parameters", parameters},
            {"population", population_},
            {"start", start_},
            {"told", {{"vectors", told_}, {"fitness", fitness_}}},
            {"state", text_}};
  }

  void take(const json& answer) {
    if (answer.contains("end")) throw btr::InputError("learner remote: " + answer.at("end").get<std::string>());
    const json& vectors = answer.at("vectors");
    const std::size_t most = population_ > 0 ? population_ : mostVectors, least = population_ > 0 ? population_ : 1;
    if (!vectors.is_array() || vectors.size() < least || vectors.size() > most)
      throw Refused("vectors", std::to_string(vectors.size()) + " vectors",
                    least == most ? std::to_string(most) : std::to_string(least) + " to " + std::to_string(most));
    Vectors taken;
    for (const json& vector : vectors) taken.push_back(vectorOf(vector, "vector " + std::to_string(taken.size())));
    const std::string text = answer.value("state", std::string());
    if (text.size() > longestState)
      throw Refused("state", std::to_string(text.size()) + " bytes", "at most " + std::to_string(longestState));
    pending_ = std::move(taken);
    text_ = text;
  }

  std::vector<double> vectorOf(const json& numbers, const std::string& place) const {
    if (!numbers.is_array() || numbers.size() != genotype_.size())
      throw Refused(place, std::to_string(numbers.size()) + " numbers", std::to_string(genotype_.size()));
    std::vector<double> vector;
    for (const json& number : numbers) {
      const btr::Parameter& parameter = genotype_[vector.size()];
      if (!number.is_number()) throw Refused(place + " " + parameter.name, "no number", "a finite number");
      vector.push_back(number.get<double>());
      try {
        btr::check(parameter, vector.back(), place + " " + parameter.name);
      } catch (const btr::InputError& error) {
        throw Refused(error.what());
      }
    }
    return vector;
  }

  std::vector<btr::Parameter> genotype_;
  std::size_t population_ = 0;
  long number_ = 0;  ///< of populations that were taken
  std::vector<double> start_, fitness_;
  Vectors pending_, told_;
  std::string text_;
  std::unique_ptr<Line> line_;
};

}  // namespace

BTR_LEARNER(Remote, "remote")
