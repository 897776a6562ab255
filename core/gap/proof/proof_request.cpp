#include "core/gap/proof/proof_request.h"

#include <nlohmann/json.hpp>

#include "core/spec/error.h"

namespace btr {

using nlohmann::json;

std::string toJsonText(const ProofRequest& request) {
  return json{{"place", request.place},
              {"seed", request.seed},
              {"cases", request.cases},
              {"engine", request.engine},
              {"scene", request.scene},
              {"kind", request.kind},
              {"dirt", request.dirt},
              {"spoiled", request.spoiled},
              {"analysis_seed", request.options.seed},
              {"design_next", request.options.designNext}}
      .dump();
}

ProofRequest proofRequestFromJson(const std::string& text) try {
  const json j = json::parse(text);
  ProofRequest request;
  request.place = j.at("place").get<std::string>();
  request.seed = j.at("seed").get<std::uint64_t>();
  request.cases = j.at("cases").get<std::size_t>();
  request.engine = j.at("engine").get<std::string>();
  request.scene = j.at("scene").get<std::string>();
  request.kind = j.at("kind").get<std::string>();
  request.dirt = j.at("dirt").get<std::string>();
  request.spoiled = j.at("spoiled").get<std::size_t>();
  request.options.seed = j.at("analysis_seed").get<std::uint64_t>();
  request.options.designNext = j.at("design_next").get<bool>();
  return request;
} catch (const json::exception& error) {
  throw InputError(std::string("what is asked of a blind trial: ") + error.what());
}

}  // namespace btr
