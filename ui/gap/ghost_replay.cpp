#include "ui/gap/ghost_replay.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "core/gap/search/gap_report.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "ui/common/numbers/format.h"
#include "ui/gap/gap_plots.h"

namespace btr::ui {
namespace {

struct GhostText {
  Q_DECLARE_TR_FUNCTIONS(GhostText)
};

using Curve = std::vector<double> GapReport::Series::*;

/// Positions of one curve as a trace; the recorded one fills in where the curve has nothing.
Trace traceOf(const GapReport::Trial& trial, const std::vector<std::size_t>& series, Curve curve) {
  Trace trace;
  trace.channels.push_back("time_s");
  for (const std::size_t s : series) trace.channels.push_back(trial.series[s].channel);
  std::vector<double> last;
  for (const std::size_t s : series) {
    // Before the first known value stands the first recorded one.
    double first = 0;
    for (const double value : trial.series[s].recorded)
      if (std::isfinite(value)) {
        first = value;
        break;
      }
    last.push_back(first);
  }
  for (std::size_t row = 0; row < trial.time_s.size(); ++row) {
    trace.values.push_back(trial.time_s[row]);
    for (std::size_t k = 0; k < series.size(); ++k) {
      const std::vector<double>& values = trial.series[series[k]].*curve;
      if (row < values.size() && std::isfinite(values[row])) last[k] = values[row];
      trace.values.push_back(last[k]);
    }
  }
  return trace;
}

bool isPlace(const std::string& quantity) {
  for (const char* known : {"position_rad", "position_m", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
    if (quantity == known) return true;
  return false;
}

}  // namespace

ReportScene sceneOf(const GapReport& report) {
  ReportScene found;
  const QString file = word(report.scene);
  if (report.scene.empty()) {
    found.problem = GhostText::tr("The report does not name its scene: it cannot be shown in 3D.");
    return found;
  }
  try {
    if (sha256(readFile(report.scene)) != report.sceneSha256) {
      found.problem = GhostText::tr("%1 has changed since the analysis: it cannot be shown in 3D.").arg(file);
      return found;
    }
    found.scene = loadScene(report.scene);
    found.models = loadModels(found.scene);
  } catch (const std::exception& error) {
    found.problem = GhostText::tr("The report's scene cannot be read: %1").arg(QString::fromUtf8(error.what()));
  }
  return found;
}

std::optional<GhostTrial> ghostTrial(const GapReport& report, std::size_t trial, const SceneSpec& scene,
                                     const ModelSet& models) {
  if (trial >= report.trials.size() || report.trials[trial].time_s.empty()) return std::nullopt;
  const GapReport::Trial& t = report.trials[trial];
  ReplayData data;
  data.title = trialName(t);
  data.note = QCoreApplication::translate("GhostReplay", "solid: recorded · orange: as given · blue: repaired");
  data.ground = scene.floor ? Ground::plain : Ground::none;
  std::vector<std::string> owners;
  if (!scene.robots.empty()) {
    const RobotSpec& robot = scene.robots.front();
    if (const auto model = models.find(robot.model); model != models.end()) data.model = model->second;
    data.robotName = robot.name;
    const auto& q = robot.orientation_wxyz;
    const auto& p = robot.position_m;
    data.fixedBase = Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    owners.push_back(robot.name);
  }
  for (const BallSpec& ball : scene.balls) {
    data.balls.push_back({ball.name, ball.radius_m});
    owners.push_back(ball.name);
  }

  std::vector<std::size_t> series;
  for (std::size_t s = 0; s < t.series.size(); ++s) {
    const std::string& channel = t.series[s].channel;
    const bool ours = std::any_of(owners.begin(), owners.end(),
                                  [&](const std::string& owner) { return channel.starts_with(owner + "."); });
    if (ours && isPlace(channel.substr(channel.rfind('.') + 1))) series.push_back(s);
  }
  if (series.empty()) return std::nullopt;

  GhostTrial shown;
  const auto with = [&](Curve curve) {
    ReplayData copy = data;
    copy.trace = traceOf(t, series, curve);
    return copy;
  };
  shown.recorded = with(&GapReport::Series::recorded);
  shown.ghosts = {{with(&GapReport::Series::asGiven), QColor(225, 105, 35, 110)},
                  {with(&GapReport::Series::withEffects), QColor(40, 120, 230, 110)}};
  return shown;
}

}  // namespace btr::ui
