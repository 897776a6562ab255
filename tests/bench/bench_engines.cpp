// The same robot, the same servos and the same motions in our simulator and in MuJoCo, one after the other in one run:
// thread CPU time per simulated second at the largest step whose outcome is within 5 % of the same engine's 0.25 ms
// run.
//   bench_engines [REPEATS]
#include <mujoco/mujoco.h>

#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "core/plugin/plugin_host.h"
#include "core/sim/bench.h"
#include "core/sim/trial.h"

namespace {

using namespace btr;

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// ---- the robot as MuJoCo's XML

std::string vec(const Eigen::Vector3d& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}
std::string quat(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q(r);
  return std::to_string(q.w()) + " " + vec(q.vec());
}

struct MujocoOptions {
  double step_s = 0.00025;
  bool engineDamping = false;  ///< the servo's speed term as MuJoCo's implicit joint damping, else in the torque
  double armature = 0;
};

void writeBody(std::ostream& out, const SceneRobot& robot, int link, const MujocoOptions& options) {
  out.precision(12);
  const Inertial& inertial = robot.model.links[static_cast<std::size_t>(link)].inertial;
  const auto& I = inertial.inertia_kg_m2;
  out << "<inertial mass='" << inertial.mass_kg << "' pos='" << vec(inertial.centreOfMass_m) << "' fullinertia='"
      << I(0, 0) << " " << I(1, 1) << " " << I(2, 2) << " " << I(0, 1) << " " << I(0, 2) << " " << I(1, 2) << "'/>\n";
  for (const Shape& shape : robot.model.links[static_cast<std::size_t>(link)].shapes) {
    if (!shape.collides || shape.kind == Shape::Kind::mesh) continue;
    Eigen::Matrix3d r = shape.pose.linear();
    std::string size;
    if (shape.kind == Shape::Kind::box) size = vec(shape.size_m / 2);
    if (shape.kind == Shape::Kind::sphere) size = std::to_string(shape.size_m.x());
    if (shape.kind == Shape::Kind::cylinder) {
      size = std::to_string(shape.size_m.x()) + " " + std::to_string(shape.size_m.y() / 2);
      r = r *
          Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();  // VRML's along y, here along z
    }
    const char* type = shape.kind == Shape::Kind::box      ? "box"
                       : shape.kind == Shape::Kind::sphere ? "sphere"
                                                           : "cylinder";
    out << "<geom type='" << type << "' size='" << size << "' pos='" << vec(shape.pose.translation()) << "' quat='"
        << quat(r) << "' contype='1' conaffinity='2'/>\n";
  }
  for (std::size_t j = 0; j < robot.model.joints.size(); ++j) {
    const Joint& joint = robot.model.joints[j];
    if (joint.parentLink != link) continue;
    out << "<body pos='" << vec(joint.origin.translation()) << "' quat='" << quat(joint.origin.linear()) << "'>\n";
    if (joint.type == Joint::Type::rotate)
      out << "<joint name='" << joint.name << "' type='hinge' axis='" << vec(joint.axis) << "' limited='true' range='"
          << joint.lower - 0.0873 << " " << joint.upper + 0.0873 << "' damping='"
          << (options.engineDamping ? robot.drives[j].d : 0.0) << "' armature='" << options.armature << "'/>\n";
    writeBody(out, robot, static_cast<int>(j) + 1, options);
    out << "</body>\n";
  }
}

std::string toXml(const Scene& scene, const MujocoOptions& options) {
  const SceneRobot& robot = scene.robots.front();
  std::ostringstream out;
  out.precision(12);
  out << "<mujoco><compiler angle='radian' balanceinertia='true'/><option timestep='" << options.step_s << "' gravity='"
      << vec(scene.gravity_m_s2) << "'/><default><geom friction='" << scene.floor->friction
      << " 0.005 0.0001'/></default>\n"
      << "<worldbody><geom type='plane' size='20 20 0.1' contype='2' conaffinity='1'/>\n<body pos='"
      << vec(robot.start.translation()) << "' quat='" << quat(robot.start.linear()) << "'><freejoint/>\n";
  writeBody(out, robot, 0, options);
  out << "</body>\n";
  for (const BallSpec& ball : scene.balls) {
    const double inertia = ball.inertiaFactor * ball.mass_kg * ball.radius_m * ball.radius_m;
    out << "<body name='" << ball.name << "' pos='" << ball.position_m[0] << " " << ball.position_m[1] << " "
        << ball.position_m[2] << "'><freejoint/><inertial mass='" << ball.mass_kg << "' pos='0 0 0' diaginertia='"
        << inertia << " " << inertia << " " << inertia << "'/><geom type='sphere' size='" << ball.radius_m
        << "' contype='3' conaffinity='3'/></body>\n";
  }
  out << "</worldbody></mujoco>\n";
  return out.str();
}

// ---- one motion in MuJoCo

struct Outcome {
  double way_m = 0, simulated_s = 0;
};

class MujocoTask {
 public:
  MujocoTask(const BenchTask& task, const MujocoOptions& options) : task_(task), options_(options) {
    mjVFS* files = static_cast<mjVFS*>(std::malloc(sizeof(mjVFS)));
    mj_defaultVFS(files);
    const std::string xml = toXml(task.scene, options);
    mj_makeEmptyFileVFS(files, "robot.xml", static_cast<int>(xml.size()));
    std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[0]));
    char error[1000] = "";
    model_ = mj_loadXML("robot.xml", files, error, sizeof error);
    mj_deleteVFS(files);
    std::free(files);
    if (!model_) {
      std::fprintf(stderr, "MuJoCo: %s\n", error);
      std::exit(1);
    }
    data_ = mj_makeData(model_);
  }
  ~MujocoTask() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoTask(const MujocoTask&) = delete;
  MujocoTask& operator=(const MujocoTask&) = delete;

  Outcome run(const std::vector<double>& parameters) {
    const SceneRobot& robot = task_.scene.robots.front();
    const std::size_t joints = robot.model.joints.size();
    mj_resetData(model_, data_);
    std::vector<int> at(joints, -1), dof(joints, -1);
    for (std::size_t j = 0; j < joints; ++j)
      if (const int id = mj_name2id(model_, mjOBJ_JOINT, robot.model.joints[j].name.c_str()); id >= 0) {
        at[j] = model_->jnt_qposadr[id];
        dof[j] = model_->jnt_dofadr[id];
        data_->qpos[at[j]] = robot.jointStart[j];
      }
    const auto motion = task_.controller->begin(task_.scene, task_.settings, parameters);
    const int ball = task_.scene.balls.empty() ? -1 : model_->nbody - 1;
    const double end = motion->duration() + (ball >= 0 ? 0.5 : 0);
    const int stepsPerPeriod =
        std::max(1, static_cast<int>(std::lround(task_.scene.controlPeriod_s / options_.step_s)));
    std::vector<JointInput> inputs(joints);
    RobotReadings none;
    none.position.resize(joints);
    none.rate.resize(joints);
    const int body = ball >= 0 ? ball : 1;
    mj_forward(model_, data_);
    const Eigen::Vector2d start(data_->xpos[3 * body], data_->xpos[3 * body + 1]);
    while (data_->time < end - 1e-9) {
      motion->command(data_->time, none, inputs);
      for (int i = 0; i < stepsPerPeriod; ++i) {
        for (std::size_t j = 0; j < joints; ++j) {
          if (dof[j] < 0) continue;
          const Drive& drive = robot.drives[j];
          const double speedTerm = options_.engineDamping ? 0 : drive.d * data_->qvel[dof[j]];
          data_->qfrc_applied[dof[j]] = std::clamp(drive.p * (inputs[j].command - data_->qpos[at[j]]) - speedTerm,
                                                   -drive.maxTorque, drive.maxTorque);
        }
        mj_step(model_, data_);
      }
    }
    mj_forward(model_, data_);
    const Eigen::Vector2d now(data_->xpos[3 * body], data_->xpos[3 * body + 1]);
    Outcome outcome{(now - start).norm(), data_->time};
    if (ball >= 0) {
      mjtNum v[6];
      mj_objectVelocity(model_, data_, mjOBJ_BODY, ball, v, 0);
      const double speed = std::hypot(v[3], v[4]), a = task_.scene.balls[0].rollingDeceleration_m_s2;
      outcome.way_m += speed * speed / (2 * a);
    }
    if (!std::isfinite(outcome.way_m) || data_->warning[mjWARN_BADQACC].number > 0) outcome.way_m = NAN;
    return outcome;
  }

 private:
  const BenchTask& task_;
  MujocoOptions options_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

struct Measured {
  std::vector<double> ways;
  double cpuPerSimulated = 0;
};

Measured measure(const BenchTask& task, const MujocoOptions& options) {
  MujocoTask runner(task, options);
  Measured measured;
  double simulated = 0;
  const double begin = cpuSeconds();
  for (const auto& parameters : task.parameters) {
    const Outcome outcome = runner.run(parameters);
    measured.ways.push_back(outcome.way_m);
    simulated += outcome.simulated_s;
  }
  measured.cpuPerSimulated = (cpuSeconds() - begin) / simulated;
  return measured;
}

double deviation(const std::vector<double>& ways, const std::vector<double>& converged) {
  double sum = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double d = ways[i] / converged[i] - 1;
    if (!std::isfinite(d)) return INFINITY;
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(ways.size()));
}

struct Choice {
  MujocoOptions options;
  double deviation = INFINITY, cpu = INFINITY;
};

/// The cheapest of the offered settings whose outcome is within 5 % of the converged one.
Choice choose(const BenchTask& task, const std::vector<double>& converged, bool tuned) {
  Choice best;
  for (const double step : {0.008, 0.004, 0.002, 0.001, 0.0005})
    for (const double armature : tuned ? std::vector<double>{0, 3e-4, 1e-3} : std::vector<double>{0}) {
      const MujocoOptions options{step, tuned, armature};
      const Measured m = measure(task, options);
      const double off = deviation(m.ways, converged);
      if (off <= 0.05 && m.cpuPerSimulated < best.cpu) best = {options, off, m.cpuPerSimulated};
    }
  return best;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(const BenchTask& task, int repeats) {
  // Ours, at the step that our own bench finds.
  const BenchResult ours = benchmark(task, 2);
  if (ours.chosen < 0) {
    std::printf("%s: no step of ours is within 5 %%\n", task.name.c_str());
    return;
  }
  const BenchStep& step = ours.steps[static_cast<std::size_t>(ours.chosen)];
  Scene scene = task.scene;
  scene.step_s = step.step_s;
  scene.nearSubsteps = step.nearSubsteps;

  const std::vector<double> converged = measure(task, {0.00025, false, 0}).ways;
  const Choice plain = choose(task, converged, false), tuned = choose(task, converged, true);
  std::vector<double> cpu[3];
  for (int repeat = 0; repeat < repeats; ++repeat) {
    double simulated = 0;
    const double begin = cpuSeconds();
    for (const auto& parameters : task.parameters)
      simulated += runTrial(scene, *task.controller, task.settings, parameters, 1, {.maximum_s = 60}).simulated_s;
    cpu[0].push_back((cpuSeconds() - begin) / simulated);
    cpu[1].push_back(std::isfinite(plain.cpu) ? measure(task, plain.options).cpuPerSimulated : NAN);
    cpu[2].push_back(std::isfinite(tuned.cpu) ? measure(task, tuned.options).cpuPerSimulated : NAN);
  }
  const double mine = median(cpu[0]);
  std::printf("%-5s %-22s %8s %12s %8s %8s\n", task.name.c_str(), "engine", "step ms", "CPU ms / s", "ratio", "off by");
  std::printf("%-5s %-22s %8g %12.2f %8.2f %7.1f%%\n", "", "UCHILSIM (ODE)", 1e3 * step.step_s, 1e3 * mine, 1.0,
              100 * step.deviation);
  const auto row = [&](const char* name, const Choice& choice, const std::vector<double>& times) {
    if (!std::isfinite(choice.cpu))
      std::printf("%-5s %-22s no step within 5 %% of its own 0.25 ms run\n", "", name);
    else
      std::printf("%-5s %-22s %8g %12.2f %8.2f %7.1f%%\n", "", name, 1e3 * choice.options.step_s, 1e3 * median(times),
                  median(times) / mine, 100 * choice.deviation);
  };
  row("MuJoCo explicit", plain, cpu[1]);
  row("MuJoCo tuned", tuned, cpu[2]);
  double mean = 0;
  for (const double way : converged) mean += way / static_cast<double>(converged.size());
  std::printf("      converged outcome: ours %.3f m, MuJoCo %.3f m\n", ours.converged.outcome_m, mean);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const PluginHost host(PLUGIN_DIR);
  const auto kick = host.controller("kick");
  const SceneSpec walkScene = loadScene(SOURCE_DIR "/resources/scenes/walk.json");
  const SceneSpec kickScene = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  std::printf("MuJoCo %s; thread CPU time, medians of %d interleaved repeats\n", mj_versionString(), repeats);
  compare(walkTask(walkScene, loadModels(walkScene)), repeats);
  compare(kickTask(kickScene, loadModels(kickScene), *kick), repeats);
  return 0;
}
