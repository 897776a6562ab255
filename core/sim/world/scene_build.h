#pragma once
#include <string>

#include "core/sim/scene.h"

namespace btr {

/// The first steps of makeScene: the scene file's numbers over the models'. No simulator version, no effects yet.
Scene sceneFromModels(const SceneSpec& spec, const ModelSet& models);

/// Sets one number of a scene by its path: "robots.leg.servos.knee.p", "robots.leg.links.lower.mass_kg",
/// "robots.leg.joints.knee.coulomb_friction_nm", "floor.friction", "balls.ball.mass_kg", "gravity_m_s2.z". Throws
/// InputError for a path that the scene does not have or a number out of its bounds.
void setByPath(Scene& scene, const std::string& path, double value);
/// The number at such a path. Throws InputError for a path that the scene does not have.
double numberByPath(Scene scene, const std::string& path);

/// Sets one of simulatorParameters().
void setSimulatorParameter(Scene& scene, const SceneSpec& spec, const std::string& name, double value);

/// Sets one of servoNumbers() or jointNumbers(). Throws InputError for a number that this kind of joint does not have.
void setDriveNumber(Drive& drive, const Joint& joint, const std::string& number, double value,
                    const std::string& place);

/// The number itself, or nullptr if this kind of joint does not have it.
double* driveNumber(Drive& drive, const Joint& joint, const std::string& number);

/// Gives the meshes that collide in the scene their hulls, once for all of its trials. `path` as the scene names the
/// model.
void makeHulls(RobotModel& model, const std::string& path, const SceneSpec& scene);

/// Mass and inertia together.
void scaleMass(Link& link, double factor);

}  // namespace btr
