#pragma once
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/remote/desk.h"

namespace btr::remote {

/// Works on one run of the database until it is finished, waits for real fitness, or stops. Its call is the number of
/// the run as text, its answer "finished", "waiting" or "stopped". A learner outside is asked on Nursery::lineOfChild,
/// see plugins/learners/remote.cpp.
class RunDesk final : public Desk {
 public:
  RunDesk(const PluginHost& host, std::string database, int jobs)
      : host_(host), database_(std::move(database)), jobs_(jobs) {}

  std::string answer(Method method, std::string_view message) override;

 private:
  const PluginHost& host_;
  const std::string database_;
  const int jobs_;
};

}  // namespace btr::remote
