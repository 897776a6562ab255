#include "app/serve/served_programs.h"

#include "app/openr/btr_openr_robots.h"
#include "core/openr/ended_text.h"
#include "core/spec/error.h"
#include "core/spec/utf8.h"

namespace btr::cli {
namespace {

/// Shorter than anybody waits for the world that asks.
constexpr double patience_s = 30;

/// Programs write what they like.
std::string asUtf8(const std::string& text) { return isUtf8(text) ? text : utf8OfLatin1(text); }

class ServedPrograms final : public remote::StickPrograms {
 public:
  explicit ServedPrograms(Session& session) : robots_(session, nullptr, patience_s) {
    for (const auto& [robot, ended] : robots_.ended())
      if (ended) throw InputError("robots " + robot + "/controller/openr: " + openr::sentenceOf(*ended));
  }

  void step() override { robots_.step(); }
  void acted(const Act& act) override { robots_.acted(act); }
  void type(const std::string& robot, const std::string& text) override { robots_.type(robot, text); }
  void end() override { robots_.end(); }

  std::vector<Line> takeLines() override {
    std::vector<Line> lines;
    for (const openr::LivePrograms::Line& line : robots_.takeLines())
      lines.push_back({line.robot, asUtf8(line.object), asUtf8(printableLine(line.text))});
    return lines;
  }

  std::map<std::string, std::string> whyEnded() const override {
    std::map<std::string, std::string> all;
    for (const auto& [robot, ended] : robots_.ended()) all[robot] = ended ? asUtf8(openr::sentenceOf(*ended)) : "";
    return all;
  }

 private:
  OpenrRobots robots_;
};

}  // namespace

remote::StickProgramsMaker stickProgramsMaker() {
  return [](Session& session) { return std::make_unique<ServedPrograms>(session); };
}

}  // namespace btr::cli
