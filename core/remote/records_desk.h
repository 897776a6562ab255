#pragma once
#include <memory>
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/remote/desk.h"
#include "core/remote/games_folder.h"
#include "core/store/database.h"

namespace uchilsim::v1 {
class MeasuredRequest;
class StartRequest;
}  // namespace uchilsim::v1

namespace btr::remote {

/// The experiment database: runs, generations, real fitness.
class RecordsDesk final : public Desk {
 public:
  RecordsDesk(const PluginHost& host, const GamesFolder& folder, std::string database)
      : host_(host), folder_(folder), path_(std::move(database)) {}

  std::string answer(Method method, std::string_view message) override;

 private:
  const Database& reading();
  Database& writing();
  std::string runs();
  std::string run(Id id);
  std::string generations(Id run, int after);
  std::string individuals(Id run, int generation);
  std::string start(const uchilsim::v1::StartRequest& request);
  std::string wanted(Id run);
  std::string measured(const uchilsim::v1::MeasuredRequest& request);

  const PluginHost& host_;
  const GamesFolder& folder_;
  const std::string path_;
  std::unique_ptr<Database> reading_, writing_;
};

}  // namespace btr::remote
