// The nodes that the reader knows: one line each, name and fields with their types.
#include <array>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "core/model/vrml/vrml_tree.h"
#include "core/spec/error.h"

namespace btr::vrml {
namespace {

constexpr std::array<std::string_view, 20> typeNames{"SFBool",     "SFColor",    "SFFloat",  "SFImage", "SFInt32",
                                                     "SFNode",     "SFRotation", "SFString", "SFTime",  "SFVec2f",
                                                     "SFVec3f",    "MFColor",    "MFFloat",  "MFInt32", "MFNode",
                                                     "MFRotation", "MFString",   "MFTime",   "MFVec2f", "MFVec3f"};

// Fields of the same type stand behind it, separated by blanks; types are separated by semicolons.
struct Line {
  const char* name;
  const char* fields;
};

#define BTR_PLACED "SFVec3f translation center scale;SFRotation rotation scaleOrientation;"
#define BTR_BOUNDED "SFVec3f bboxCenter bboxSize;"
#define BTR_SENSOR "SFVec3f translation;SFRotation rotation;SFInt32 sensorId;SFString name;MFNode children;"

const Line table[] = {
    // Grouping
    {"Anchor", BTR_BOUNDED "MFNode children;SFString description;MFString parameter url"},
    {"Billboard", BTR_BOUNDED "SFVec3f axisOfRotation;MFNode children"},
    {"Collision", BTR_BOUNDED "MFNode children;SFBool collide;SFNode proxy"},
    {"Group", BTR_BOUNDED "MFNode children"},
    {"Inline", BTR_BOUNDED "MFString url"},
    {"LOD", "MFNode level;SFVec3f center;MFFloat range"},
    {"Switch", "MFNode choice;SFInt32 whichChoice"},
    {"Transform", BTR_PLACED BTR_BOUNDED "MFNode children"},
    // Shapes and looks
    {"Shape", "SFNode appearance geometry"},
    {"Appearance", "SFNode material texture textureTransform"},
    {"Material", "SFFloat ambientIntensity shininess transparency;SFColor diffuseColor emissiveColor specularColor"},
    {"ImageTexture", "MFString url;SFBool repeatS repeatT"},
    {"MovieTexture", "MFString url;SFBool repeatS repeatT loop;SFFloat speed;SFTime startTime stopTime"},
    {"PixelTexture", "SFImage image;SFBool repeatS repeatT"},
    {"TextureTransform", "SFVec2f center scale translation;SFFloat rotation"},
    // Geometry
    {"Box", "SFVec3f size"},
    {"Cone", "SFFloat bottomRadius height;SFBool side bottom"},
    {"Cylinder", "SFFloat radius height;SFBool side bottom top"},
    {"Sphere", "SFFloat radius"},
    {"ElevationGrid",
     "SFNode color normal texCoord;MFFloat height;SFBool ccw colorPerVertex normalPerVertex solid;SFFloat creaseAngle "
     "xSpacing zSpacing;SFInt32 xDimension zDimension"},
    {"Extrusion",
     "SFBool beginCap ccw convex endCap solid;SFFloat creaseAngle;MFVec2f crossSection scale;MFRotation "
     "orientation;MFVec3f spine"},
    {"IndexedFaceSet",
     "SFNode color coord normal texCoord;SFBool ccw colorPerVertex convex normalPerVertex solid;MFInt32 colorIndex "
     "coordIndex normalIndex texCoordIndex;SFFloat creaseAngle"},
    {"IndexedLineSet", "SFNode color coord;MFInt32 colorIndex coordIndex;SFBool colorPerVertex"},
    {"PointSet", "SFNode color coord"},
    {"Text", "MFString string;SFNode fontStyle;MFFloat length;SFFloat maxExtent"},
    {"FontStyle",
     "MFString family justify;SFBool horizontal leftToRight topToBottom;SFString language style;SFFloat size spacing"},
    {"Color", "MFColor color"},
    {"Coordinate", "MFVec3f point"},
    {"Normal", "MFVec3f vector"},
    {"TextureCoordinate", "MFVec2f point"},
    // Lights, sound, surroundings: known, so that a wrong field in them is found, but nothing is made of them
    {"AudioClip", "SFString description;SFBool loop;SFFloat pitch;SFTime startTime stopTime;MFString url"},
    {"Background",
     "MFFloat groundAngle skyAngle;MFColor groundColor skyColor;MFString backUrl bottomUrl frontUrl leftUrl rightUrl "
     "topUrl"},
    {"DirectionalLight", "SFFloat ambientIntensity intensity;SFColor color;SFVec3f direction;SFBool on"},
    {"Fog", "SFColor color;SFString fogType;SFFloat visibilityRange"},
    {"NavigationInfo", "MFFloat avatarSize;SFBool headlight;SFFloat speed visibilityLimit;MFString type"},
    {"PointLight", "SFFloat ambientIntensity intensity radius;SFColor color;SFVec3f attenuation location;SFBool on"},
    {"Sound",
     "SFVec3f direction location;SFFloat intensity maxBack maxFront minBack minFront priority;SFNode source;SFBool "
     "spatialize"},
    {"SpotLight",
     "SFFloat ambientIntensity beamWidth cutOffAngle intensity radius;SFColor color;SFVec3f attenuation direction "
     "location;SFBool on"},
    {"Viewpoint", "SFFloat fieldOfView;SFBool jump;SFRotation orientation;SFVec3f position;SFString description"},
    {"WorldInfo", "MFString info;SFString title"},
    // Interaction
    {"CylinderSensor", "SFBool autoOffset enabled;SFFloat diskAngle maxAngle minAngle offset"},
    {"PlaneSensor", "SFBool autoOffset enabled;SFVec2f maxPosition minPosition;SFVec3f offset"},
    {"ProximitySensor", "SFVec3f center size;SFBool enabled"},
    {"SphereSensor", "SFBool autoOffset enabled;SFRotation offset"},
    {"TimeSensor", "SFTime cycleInterval startTime stopTime;SFBool enabled loop"},
    {"TouchSensor", "SFBool enabled"},
    {"VisibilitySensor", "SFVec3f center size;SFBool enabled"},
    {"ColorInterpolator", "MFFloat key;MFColor keyValue"},
    {"CoordinateInterpolator", "MFFloat key;MFVec3f keyValue"},
    {"NormalInterpolator", "MFFloat key;MFVec3f keyValue"},
    {"OrientationInterpolator", "MFFloat key;MFRotation keyValue"},
    {"PositionInterpolator", "MFFloat key;MFVec3f keyValue"},
    {"ScalarInterpolator", "MFFloat key keyValue"},
    // OpenHRP and Choreonoid, with our optional fields
    {"Humanoid", BTR_PLACED BTR_BOUNDED
     "MFNode humanoidBody skeleton joints segments sites viewpoints skinCoord skin skinNormal;SFString name "
     "version;MFString info"},
    {"Joint", BTR_PLACED
     "MFNode children;SFString name jointType primitive;SFInt32 jointId;SFVec3f jointAxis;MFFloat llimit ulimit "
     "lvlimit "
     "uvlimit climit stiffness;SFRotation limitOrientation;SFFloat gearRatio rotorInertia rotorResistor torqueConst "
     "encoderPulse equivalentInertia maxTorque pGain iGain dGain coulombFriction viscousFriction backlash "
     "commandDelay noLoadSpeed"},
    {"Segment",
     BTR_BOUNDED "SFString name massGroup;SFVec3f centerOfMass;SFFloat mass;MFFloat momentsOfInertia;MFNode children "
                 "collision;SFNode coord;MFNode displacers"},
    {"Part", "SFString name;SFInt32 whichChoice;MFNode choice"},
    {"AccelerationSensor", BTR_SENSOR "SFVec3f maxAcceleration"},
    {"Gyro", BTR_SENSOR "SFVec3f maxAngularVelocity"},
    {"ForceSensor", BTR_SENSOR "SFVec3f maxForce maxTorque"},
    {"PressureSensor", BTR_SENSOR "SFFloat maxPressure"},
    {"VisionSensor",
     BTR_SENSOR "SFString type;SFInt32 width height;SFFloat fieldOfView frontClipDistance backClipDistance frameRate"},
    {"RangeSensor", BTR_SENSOR "SFFloat scanAngle scanStep scanRate minDistance maxDistance;SFBool on"},
};

constexpr std::array<std::string_view, 10> robotWords{
    "Humanoid",    "Joint",        "Segment",     "Part",           "Gyro",
    "ForceSensor", "VisionSensor", "RangeSensor", "PressureSensor", "AccelerationSensor"};

std::unordered_map<std::string_view, NodeType> readTable() {
  std::unordered_map<std::string_view, NodeType> types;
  for (const Line& line : table) {
    NodeType& type = types[line.name];
    type.name = line.name;
    std::istringstream groups(line.fields);
    for (std::string group; std::getline(groups, group, ';');) {
      std::istringstream words(group);
      std::string typeName, field;
      words >> typeName;
      FieldType valueType{};
      if (!fieldType(typeName, valueType)) throw InputError(type.name + ": the table names no type " + typeName);
      while (words >> field) type.fields.push_back({field, valueType, nullptr});
    }
  }
  return types;
}

}  // namespace

bool fieldType(std::string_view name, FieldType& type) {
  for (std::size_t i = 0; i < typeNames.size(); ++i)
    if (typeNames[i] == name) return type = static_cast<FieldType>(i), true;
  return false;
}

int arity(FieldType type) {
  switch (type) {
    case FieldType::SFVec2f:
    case FieldType::MFVec2f:
      return 2;
    case FieldType::SFColor:
    case FieldType::MFColor:
    case FieldType::SFVec3f:
    case FieldType::MFVec3f:
      return 3;
    case FieldType::SFRotation:
    case FieldType::MFRotation:
      return 4;
    default:
      return 1;
  }
}

bool isMany(FieldType type) { return type >= FieldType::MFColor; }

const NodeType* builtIn(std::string_view name) {
  static const auto types = readTable();
  const auto found = types.find(name);
  return found == types.end() ? nullptr : &found->second;
}

bool isRobotWord(std::string_view name) {
  for (const auto word : robotWords)
    if (word == name) return true;
  return false;
}

const FieldDescription* NodeType::find(std::string_view field) const {
  for (const FieldDescription& description : fields)
    if (description.name == field) return &description;
  return nullptr;
}

const Value* Node::given(std::string_view field) const {
  for (const Field& each : fields)
    if (each.name == field) return each.value.get();
  return nullptr;
}

const Value* Node::find(std::string_view field) const {
  if (const Value* value = given(field)) return value;
  const FieldDescription* description = type->find(field);
  return description ? description->byDefault.get() : nullptr;
}

void Document::warn(int file, int line, const std::string& text, Warning::Loss loss) {
  constexpr std::size_t most = 200;
  if (warnings.size() > most) return;
  if (warnings.size() == most) {
    warnings.push_back({line, "more warnings follow that are not listed"});
    return;
  }
  const std::string where = file > 0 ? places[static_cast<std::size_t>(file)] + ":" + std::to_string(line) + ": " : "";
  warnings.push_back({line, where + text, loss});
}

void Document::fail(const Node& node, const std::string& message) const {
  throw InputError(places[static_cast<std::size_t>(node.file)], node.line, message);
}

}  // namespace btr::vrml
