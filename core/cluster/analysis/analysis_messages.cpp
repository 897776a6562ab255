#include "core/cluster/analysis/analysis_messages.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string nameAndHash(const fs::path& file) {
  return "file " + file.filename().string() + ' ' + sha256(readFile(file));
}

/// Everything that a recording's file and its mapping made of it.
std::string numbersOf(const Recording& recording) {
  Parts parts;
  for (std::size_t i = 0; i < recording.columns.size(); ++i) {
    parts.push_back(recording.channels[i]);
    const auto* bytes = reinterpret_cast<const char*>(recording.columns[i].data());
    parts.emplace_back(bytes, recording.columns[i].size() * sizeof(double));
  }
  return sha256(pack(parts));
}

void addRecordings(Parts& inputs, const std::vector<Recording>& recordings) {
  for (const Recording& recording : recordings) {
    const std::string name = fs::path(recording.source).filename().string();
    inputs.push_back("file " + name + ' ' + recording.sha256);
    inputs.push_back("reading of " + name + ' ' + numbersOf(recording));
  }
}

}  // namespace

bool isAnalysis(const Parts& message) { return message.front() == "analysis" || message.front() == "repair"; }

std::string pack(const RecordedAnalysis& analysis) {
  Parts parts{toJsonText(analysis.simulator), toText(analysis.pose), std::to_string(analysis.seed)};
  for (const RecordedAnalysis::Table& table : analysis.recordings)
    parts.insert(parts.end(), {table.name, table.csv, table.mappingJson});
  return pack(parts);
}

RecordedAnalysis recordedAnalysisFrom(const std::string& bytes) {
  const Parts parts = unpack(bytes);
  constexpr std::size_t head = 3, perTable = 3;
  if (parts.size() < head || (parts.size() - head) % perTable != 0)
    throw InputError("the recordings of an analysis are cut short");
  RecordedAnalysis analysis;
  analysis.simulator = simulatorFromJson(parts[0], "simulator of an analysis");
  analysis.pose = robotPose(parts[1], "an analysis");
  analysis.seed = std::stoull(parts[2]);
  for (std::size_t i = head; i < parts.size(); i += perTable)
    analysis.recordings.push_back({parts[i], parts[i + 1], parts[i + 2]});
  return analysis;
}

Parts partsOf(const RecordedFinding& finding) { return {toJsonText(finding.simulator), finding.evidence}; }

RecordedFinding findingFrom(const Parts& parts) {
  if (parts.size() != 2) throw InputError("what an analysis found is cut short");
  return {simulatorFromJson(parts[0], "simulator of an analysis"), parts[1]};
}

std::string toJsonText(const AnalysisRequest& request) {
  return json{{"scene", request.scene},
              {"recordings", request.recordings},
              {"held_out", request.heldOut},
              {"mapping", request.mapping},
              {"simulator", request.simulator},
              {"out", request.out},
              {"seed", request.options.seed},
              {"maximum_effects", request.options.maximumEffects},
              {"effects", request.options.effects},
              {"design_next", request.options.designNext},
              {"learn_rest", request.options.learnRest},
              {"as_recorded", request.options.asRecorded}}
      .dump();
}

AnalysisRequest analysisRequestFromJson(const std::string& text) try {
  const json j = json::parse(text);
  AnalysisRequest request;
  request.scene = j.at("scene").get<std::string>();
  request.recordings = j.at("recordings").get<std::vector<std::string>>();
  request.heldOut = j.at("held_out").get<std::vector<std::string>>();
  request.mapping = j.at("mapping").get<std::string>();
  request.simulator = j.at("simulator").get<std::string>();
  request.out = j.at("out").get<std::string>();
  request.options.seed = j.at("seed").get<std::uint64_t>();
  request.options.maximumEffects = j.at("maximum_effects").get<int>();
  request.options.effects = j.at("effects").get<std::vector<std::string>>();
  request.options.designNext = j.at("design_next").get<bool>();
  request.options.learnRest = j.at("learn_rest").get<bool>();
  request.options.asRecorded = j.at("as_recorded").get<bool>();
  return request;
} catch (const json::exception& error) {
  throw InputError(std::string("what is asked of an analysis: ") + error.what());
}

Parts inputsOf(const AnalysisRequest& request, const GapProblem& problem) {
  Parts inputs{nameAndHash(request.scene)};
  if (!request.simulator.empty()) inputs.push_back(nameAndHash(request.simulator));
  for (const RobotSpec& robot : problem.scene.robots)
    inputs.push_back(nameAndHash(fs::path(problem.scene.directory) / robot.model));
  addRecordings(inputs, problem.recordings);
  addRecordings(inputs, problem.heldOut);
  return inputs;
}

Parts inputsOf(const GapProblem& problem) {
  Parts inputs;
  addRecordings(inputs, problem.recordings);
  return inputs;
}

void append(Parts& parts, const WorkerPool::Reply& reply) {
  parts.emplace_back(reply.ok ? "R" : reply.killed ? "K" : "F");
  parts.push_back(reply.ok ? reply.bytes : reply.failure);
}

WorkerPool::Reply replyFrom(const std::string& state, const std::string& bytes) {
  WorkerPool::Reply reply;
  reply.ok = state == "R";
  reply.killed = state == "K";
  (reply.ok ? reply.bytes : reply.failure) = bytes;
  return reply;
}

}  // namespace btr
