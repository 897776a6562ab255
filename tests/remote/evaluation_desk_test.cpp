// Whole trials for a client are those of a run.
#include "core/remote/evaluation_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/run/loop/back_to_reality.h"
#include "core/run/loop/search.h"
#include "core/spec/json_reader.h"
#include "tests/remote/remote_folder.h"
#include "uchilsim.pb.h"

namespace {

using namespace btr;
using namespace btr::remote;
using namespace btr::test;
using testing::HasSubstr;
namespace v1 = uchilsim::v1;

class EvaluationDeskTest : public testing::Test {
 protected:
  v1::EvaluateRequest request(const std::vector<std::vector<double>>& vectors) const {
    v1::EvaluateRequest request;
    request.mutable_experiment()->set_file("experiments/kick-short.json");
    request.set_vectors(static_cast<int>(vectors.size()));
    for (const auto& vector : vectors)
      for (const double number : vector) request.add_parameters(number);
    return request;
  }
  std::string json(const std::function<void(nlohmann::json&)>& settle) const {
    nlohmann::json text = nlohmann::json::parse(readFile((files.server() / "experiments/kick-short.json").string()));
    settle(text);
    return text.dump();
  }

  RemoteFolder files;
  GamesFolder folder{files.server().string(), false};
  EvaluationDesk desk{plugins(), folder, "", 2};
};

TEST_F(EvaluationDeskTest, GivesTheBitsThatARunOfTheSameSeedHas) {
  const std::string path = (files.server() / "experiments/kick-short.json").string();
  ExperimentSpec spec = loadExperiment(path);
  spec.learner.settings["population"] = 6;
  spec.stages = {
      {"first_generations", 1}, {"next_generations", 1}, {"total_generations", 2}, {"measured_individuals", 2}};
  spec.reality = "person";
  Database db = Database::open(files.file("a.db"), Database::Mode::create);
  const Id run = startRun(db, plugins(), spec, 11);
  continueRun(db, plugins(), run, StopFlag{false}, {.jobs = 1, .progress = {}});
  const std::vector<IndividualRecord> all = db.individuals(run, 1);
  ASSERT_EQ(6u, all.size());
  std::vector<std::vector<double>> vectors;
  for (const IndividualRecord& individual : all) vectors.push_back(individual.parameters);
  v1::EvaluateRequest same = request(vectors);
  same.set_seed(11);
  const auto reply = answered<v1::EvaluateReply>(desk, Method::evaluate, same);
  ASSERT_EQ(6, reply.trials_size());
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(all[static_cast<std::size_t>(i)].fitness, reply.trials(i).fitness());
    EXPECT_EQ(all[static_cast<std::size_t>(i)].traceSha256, reply.trials(i).trace_sha256());
  }
}

TEST_F(EvaluationDeskTest, SeesThatAFileBehindTheSamePathIsAnotherOne) {
  const auto changed = [&](const std::string& name, const std::string& what, const std::string& with) {
    std::string text = readFile((files.server() / name).string());
    const std::size_t at = text.find(what);
    EXPECT_NE(std::string::npos, at) << name << ": " << what;
    files.write(name, text.replace(at, what.size(), with));
  };
  v1::ExperimentRequest asked;
  asked.mutable_experiment()->set_file("experiments/kick-short.json");
  const auto described = answered<v1::ExperimentReply>(desk, Method::describeExperiment, asked);
  std::vector<double> vector;
  for (const v1::NumberParts& p : described.genotype()) vector.push_back(p.by_default());
  const auto bits = [&](EvaluationDesk& by) {
    return answered<v1::EvaluateReply>(by, Method::evaluate, request({vector})).trials(0).trace_sha256();
  };
  std::vector<std::string> seen{bits(desk)};
  EXPECT_EQ(seen.back(), bits(desk));
  const auto expectOther = [&] {
    const std::string now = bits(desk);
    EXPECT_EQ(0, std::ranges::count(seen, now));
    EvaluationDesk fresh(plugins(), folder, "", 1);
    EXPECT_EQ(bits(fresh), now);
    seen.push_back(now);
  };
  changed("scenes/kick.json", "\"radius_m\": 0.0425", "\"radius_m\": 0.05");
  expectOther();
  changed("robots/ers7.wrl", "centerOfMass -0.002", "centerOfMass 0.01");
  expectOther();
}

TEST_F(EvaluationDeskTest, SaysWhatAVectorIs) {
  v1::ExperimentRequest asked;
  asked.mutable_experiment()->set_file("experiments/kick-short.json");
  const auto reply = answered<v1::ExperimentReply>(desk, Method::describeExperiment, asked);
  EXPECT_EQ(25, reply.genotype_size());
  EXPECT_EQ("m", reply.unit());
  EXPECT_FALSE(reply.genotype(0).meaning().empty());
}

TEST_F(EvaluationDeskTest, NamesVectorAndParameterOfWhatIsNotAllowed) {
  v1::ExperimentRequest asked;
  asked.mutable_experiment()->set_file("experiments/kick-short.json");
  const auto described = answered<v1::ExperimentReply>(desk, Method::describeExperiment, asked);
  std::vector<double> vector;
  for (const v1::NumberParts& p : described.genotype()) vector.push_back(p.by_default());
  std::vector<double> wrong = vector;
  wrong[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused(desk, Method::evaluate, request({vector, wrong})),
              HasSubstr("vector 1 " + described.genotype(3).name()));
  wrong[3] = 1e9;
  EXPECT_THAT(refused(desk, Method::evaluate, request({wrong})), HasSubstr("vector 0 "));
  v1::EvaluateRequest fewer = request({vector});
  fewer.set_vectors(2);
  EXPECT_THAT(refused(desk, Method::evaluate, fewer), HasSubstr("2 vectors of 25 numbers"));
  fewer.set_vectors(0);
  EXPECT_THAT(refused(desk, Method::evaluate, fewer), HasSubstr("1 to 100000"));
}

TEST_F(EvaluationDeskTest, AnExperimentThatIsSentStartsNoProgramAndLoadsNoPlugin) {
  const auto said = [&](const std::function<void(nlohmann::json&)>& settle) {
    v1::ExperimentRequest asked;
    asked.mutable_experiment()->set_json(json(settle));
    asked.mutable_experiment()->set_directory("experiments");
    return refused(desk, Method::describeExperiment, asked);
  };
  EXPECT_EQ("accepted", said([](auto&) {}));
  EXPECT_THAT(said([](auto& e) { e["plugins"] = {"/tmp"}; }), HasSubstr("/plugins"));
  EXPECT_THAT(said([](auto& e) {
                e["reality"] = {{"name", "program"}, {"settings", {{"program", "/bin/sh"}}}};
              }),
              HasSubstr("not allowed"));
  EXPECT_THAT(said([](auto& e) {
                e["reality"] = {{"name", "csv_folder"}, {"settings", {{"folder", "/tmp"}}}};
              }),
              HasSubstr("not allowed"));
  EXPECT_THAT(said([](auto& e) { e["scene"] = "../../secret.json"; }), HasSubstr("below the server's folder"));
  EXPECT_THAT(said([](auto& e) { e["scene"] = "/etc/passwd"; }), HasSubstr("below the server's folder"));
}

}  // namespace
