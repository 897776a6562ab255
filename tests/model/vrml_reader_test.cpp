// What the VRML reader makes of well-formed files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <locale>

#include "tests/model/model_texts.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

// PROTO declarations as the OpenHRP files have them, shortened.
const std::string protos = R"(
PROTO Joint [ exposedField SFVec3f center 0 0 0 exposedField MFNode children [] exposedField SFVec3f translation 0 0 0
  exposedField SFRotation rotation 0 0 1 0 exposedField SFString jointType "" exposedField SFInt32 jointId -1
  exposedField SFVec3f jointAxis 0 0 1 exposedField MFFloat llimit [] exposedField MFFloat ulimit []
  exposedField SFFloat maxTorque 0 exposedField SFFloat pGain 0 ]
{ Transform { center IS center children IS children translation IS translation rotation IS rotation } }
PROTO Segment [ exposedField SFVec3f centerOfMass 0 0 0 exposedField SFFloat mass 0
  exposedField MFFloat momentsOfInertia [ 0 0 0 0 0 0 0 0 0 ] exposedField MFNode children [] ]
{ Group { children IS children } }
PROTO Humanoid [ field SFString name "" exposedField MFNode humanoidBody [] ] { Group { children IS humanoidBody } }
)";

TEST(VrmlReader, ReadsTheVocabularyThroughItsProtos) {
  const RobotModel model = parseVrml(vrmlHeader + protos + R"(
    DEF R Humanoid { name "Tiny" humanoidBody [ DEF WAIST Joint { jointType "fixed" children [
      DEF BASE Segment { mass 2 centerOfMass 0 0 0.1 momentsOfInertia [ 1 0 0 0 2 0 0 0 2.5 ] }
      DEF KNEE Joint { jointType "rotate" jointId 3 jointAxis 0 -1 0 translation 1 2 3 llimit -0.5 ulimit [ 0.25 ] maxTorque 4
        children [ DEF SHANK Segment { mass 1 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ] } ] } ] } ] })",
                                     "r.wrl");
  EXPECT_EQ("Tiny", model.name);
  EXPECT_FALSE(model.freeBase);
  ASSERT_EQ(2u, model.links.size());
  EXPECT_EQ("BASE", model.links[0].name);
  EXPECT_DOUBLE_EQ(2, model.links[0].inertial.mass_kg);
  EXPECT_DOUBLE_EQ(2.5, model.links[0].inertial.inertia_kg_m2(2, 2));
  const Joint& knee = model.joints.at(0);
  EXPECT_EQ("KNEE", knee.name);
  EXPECT_EQ(3, knee.id);
  EXPECT_EQ(Vector3d(0, -1, 0), knee.axis);
  EXPECT_EQ(Vector3d(1, 2, 3), knee.origin.translation());
  EXPECT_DOUBLE_EQ(-0.5, knee.lower);
  EXPECT_DOUBLE_EQ(0.25, knee.upper);
  EXPECT_EQ(4, knee.servo.maxTorque_nm);
  EXPECT_FALSE(knee.servo.p_nm_rad.has_value()) << "the default of a PROTO is no number that the file gave";
}

TEST(VrmlReader, ReadsEveryOptionalServoField) {
  const Joint joint =
      parseVrml(robotWithJoint(R"(jointType "rotate" llimit -1 ulimit 1 lvlimit -3 uvlimit 2 maxTorque 1 pGain 2
    iGain 3 dGain 4 coulombFriction 5 viscousFriction 6 backlash 7 commandDelay 8 gearRatio 9 rotorInertia 10 primitive "PRM:/x")"),
                "r.wrl")
          .joints.at(0);
  EXPECT_EQ(1, joint.servo.maxTorque_nm);
  EXPECT_EQ(2, joint.servo.p_nm_rad);
  EXPECT_EQ(3, joint.servo.i_nm_rad_s);
  EXPECT_EQ(4, joint.servo.d_nm_s_rad);
  EXPECT_EQ(5, joint.servo.coulombFriction_nm);
  EXPECT_EQ(6, joint.servo.viscousFriction_nm_s_rad);
  EXPECT_EQ(7, joint.servo.backlash_rad);
  EXPECT_EQ(8, joint.servo.commandDelay_s);
  EXPECT_EQ(9, joint.servo.gearRatio);
  EXPECT_EQ(10, joint.servo.rotorInertia_kg_m2);
  EXPECT_EQ(2, joint.speedLimit);
  EXPECT_EQ("PRM:/x", joint.primitive);
}

TEST(VrmlReader, ReadsTheAxisAsAWordOfOldFiles) {
  for (const auto& [word, axis] :
       {std::pair{"X", Vector3d::UnitX().eval()}, {"Y", Vector3d::UnitY().eval()}, {"Z", Vector3d::UnitZ().eval()}}) {
    const auto text = robotWithJoint("jointType \"slide\" jointAxis \"" + std::string(word) + "\"");
    EXPECT_EQ(axis, parseVrml(text, "r.wrl").joints.at(0).axis);
  }
  EXPECT_THAT(vrmlRefusal(robotWithJoint("jointType \"slide\" jointAxis \"W\"")),
              HasSubstr("jointAxis \"W\" is not allowed"));
}

TEST(VrmlReader, TransformsMayStandBetweenJointsAndSegments) {
  // A quarter turn about z at (1 0 0) holds the joint, which stands 1 m along its x.
  const RobotModel model =
      parseVrml(vrmlHeader + R"(Transform { children DEF R Humanoid { humanoidBody DEF A Joint { children [
    Segment { name "base" mass 1 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ] }
    Transform { translation 1 0 0 rotation 0 0 1 1.5707963267948966 children Group { children
      DEF B Joint { jointType "rotate" translation 1 0 0 children
        Transform { translation 0 0 2 children DEF S Segment { mass 1 centerOfMass 0 0 1 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ]
          children Shape { geometry Sphere { radius 0.5 } } } } } } } ] } } })",
                "r.wrl");
  EXPECT_EQ("base", model.links.at(0).name);
  EXPECT_TRUE(model.joints.at(0).origin.translation().isApprox(Vector3d(1, 1, 0), 1e-12));
  EXPECT_TRUE(model.links.at(1).inertial.centreOfMass_m.isApprox(Vector3d(0, 0, 3), 1e-12));
  EXPECT_TRUE(model.links.at(1).shapes.at(0).pose.translation().isApprox(Vector3d(0, 0, 2), 1e-12));
}

TEST(VrmlReader, AJointInsideASegmentBelongsToItsLink) {
  const auto model =
      parseVrml(vrmlHeader + "Humanoid { humanoidBody DEF A Joint { children DEF SA Segment { " + goodMass +
                    " children Transform { translation 0 0 1 children DEF B Joint { jointType \"rotate\" children "
                    "DEF SB Segment { " +
                    goodMass + " } } } } } }",
                "r.wrl");
  ASSERT_EQ(2u, model.links.size());
  EXPECT_EQ("SB", model.links[1].name);
  EXPECT_EQ(Vector3d(0, 0, 1), model.joints[0].origin.translation());
}

TEST(VrmlReader, SegmentsOfOneJointBecomeOneBody) {
  const auto model = parseVrml(vrmlHeader + R"(Humanoid { humanoidBody DEF A Joint { children [
    DEF FIRST Segment { mass 2 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ] }
    DEF SECOND Segment { mass 3 centerOfMass 0.5 0 0 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ] } ] } })",
                               "r.wrl");
  ASSERT_EQ(1u, model.links.size());
  EXPECT_EQ("FIRST", model.links[0].name);
  EXPECT_DOUBLE_EQ(5, model.links[0].inertial.mass_kg);
  EXPECT_NEAR(0.3, model.links[0].inertial.centreOfMass_m.x(), 1e-12);
  EXPECT_NEAR(2.3, model.links[0].inertial.inertia_kg_m2(1, 1), 1e-12);
}

TEST(VrmlReader, SensorsStandInJointsAndSegments) {
  const auto model =
      parseVrml(robotWith(R"(DEF ACC AccelerationSensor { sensorId 0 } DEF GYRO Gyro { translation 0 0 1 }
    Transform { translation 1 0 0 children DEF EYE VisionSensor { width 64 height 48 fieldOfView 1 } }
    DEF F ForceSensor {} DEF P PressureSensor {} DEF D RangeSensor {})"),
                "r.wrl");
  ASSERT_EQ(6u, model.sensors.size());
  EXPECT_EQ("ACC", model.sensors[0].name);
  EXPECT_EQ(Sensor::Kind::gyro, model.sensors[1].kind);
  EXPECT_EQ(Vector3d(1, 0, 0), model.sensors[2].pose.translation());
  EXPECT_EQ(48, model.sensors[2].height);
  EXPECT_EQ(Sensor::Kind::range, model.sensors[5].kind);
}

TEST(VrmlReader, CollisionStandsInForWhatIsDrawn) {
  const auto text = [](const std::string& fields) {
    return vrmlHeader + "Humanoid { humanoidBody DEF A Joint { children DEF S Segment { " + goodMass + " " + fields +
           " } } }";
  };
  const std::string drawn =
      "children [ Shape { geometry Box { size 1 1 1 } } Part { name \"red\" choice Shape { geometry Cone {} } } ]";
  auto shapes = parseVrml(text(drawn), "r.wrl").links[0].shapes;
  ASSERT_EQ(2u, shapes.size());
  EXPECT_TRUE(shapes[0].drawn && shapes[0].collides);
  EXPECT_TRUE(shapes[1].drawn && !shapes[1].collides);
  EXPECT_EQ("red", shapes[1].part);

  shapes = parseVrml(text(drawn + " collision Shape { geometry Sphere {} }"), "r.wrl").links[0].shapes;
  ASSERT_EQ(3u, shapes.size());
  EXPECT_EQ(Shape::Kind::sphere, shapes[0].kind);
  EXPECT_TRUE(shapes[0].collides && !shapes[0].drawn);
  EXPECT_TRUE(shapes[1].drawn && !shapes[1].collides);

  shapes = parseVrml(text("collision [ ] " + drawn), "r.wrl").links[0].shapes;
  for (const Shape& shape : shapes) EXPECT_FALSE(shape.collides);
}

TEST(VrmlReader, SwitchAndLodGiveWhatIsShown) {
  const auto shapes = shapesOf(R"(Switch { whichChoice 1 choice [ Shape { geometry Box {} } NULL ] }
    Switch { whichChoice 1 choice [ NULL Shape { geometry Sphere {} } ] } Switch { choice Shape { geometry Box {} } }
    LOD { level [ Shape { geometry Cylinder {} } Shape { geometry Box {} } ] })");
  ASSERT_EQ(2u, shapes.size());
  EXPECT_EQ(Shape::Kind::sphere, shapes[0].kind);
  EXPECT_EQ(Shape::Kind::cylinder, shapes[1].kind);
}

TEST(VrmlReader, ReadsColoursAndOpacity) {
  const auto shapes = shapesOf(
      "Shape { appearance Appearance { material Material { diffuseColor 0.1 0.2 0.3 transparency 0.25 } } geometry Box "
      "{} }");
  EXPECT_THAT(shapes.at(0).colour, testing::Pointwise(testing::FloatEq(), {0.1f, 0.2f, 0.3f, 0.75f}));
}

TEST(VrmlReader, UseRepeatsANodeAtAnotherPlace) {
  const auto shapes =
      shapesOf("DEF S Shape { geometry Sphere { radius 2 } } Transform { translation 0 5 0 children USE S }");
  ASSERT_EQ(2u, shapes.size());
  EXPECT_EQ(2, shapes[1].size_m.x());
  EXPECT_EQ(Vector3d(0, 5, 0), shapes[1].pose.translation());
}

TEST(VrmlReader, ExpandsProtosWithDefaultsAndNestedIs) {
  const auto model = parseVrml(robotWith("Pair { size 4 4 4 at 0 0 7 }", R"(
    PROTO Brick [ field SFVec3f size 1 2 3 field SFVec3f at 0 0 0 eventIn SFTime go ]
      { Transform { translation IS at children Shape { geometry Box { size IS size } } } }
    PROTO Pair [ field SFVec3f size 9 9 9 field SFVec3f at 1 1 1 ]
      { Group { children [ Brick { size IS size } Brick { at IS at } ] } })"),
                               "r.wrl");
  const auto& shapes = model.links.at(0).shapes;
  ASSERT_EQ(2u, shapes.size());
  EXPECT_EQ(Vector3d(4, 4, 4), shapes[0].size_m);
  EXPECT_EQ(Vector3d(0, 0, 0), shapes[0].pose.translation());
  EXPECT_EQ(Vector3d(1, 2, 3), shapes[1].size_m);
  EXPECT_EQ(Vector3d(0, 0, 7), shapes[1].pose.translation());
}

TEST(VrmlReader, SkipsUnknownNodesWithAWarningThatNamesTheLine) {
  const auto model =
      parseVrml(robotWith("\nSparkle { a [ 1 2 { \"}\" } ] b \"x\" }\nShape { geometry Box {} }"), "r.wrl");
  EXPECT_EQ(1u, model.links.at(0).shapes.size());
  ASSERT_EQ(1u, model.warnings.size());
  EXPECT_EQ(6, model.warnings[0].line);
  EXPECT_THAT(model.warnings[0].text, HasSubstr("Sparkle"));
}

TEST(VrmlReader, ReadsEveryOtherNodeOfVrml97) {
  const auto model = parseVrml(robotWith("Shape { geometry Box {} }", R"(
    WorldInfo { title "t" info [ "a" "b" ] } NavigationInfo { type [ "EXAMINE" ] avatarSize 0.5 headlight TRUE }
    Background { skyColor 0 0 1 groundAngle [ 1 2 ] } Viewpoint { position 0 0 3 orientation 0 1 0 1 }
    DirectionalLight { direction 0 0 -1 } PointLight { location 1 2 3 } SpotLight { cutOffAngle 1 } Fog { fogType "LINEAR" }
    DEF T TimeSensor { cycleInterval 2 loop TRUE } DEF I PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 1 1 1 ] }
    ROUTE T.fraction_changed TO I.set_fraction Script { field SFInt32 a 1 url "javascript: function f() { }" }
    Shape { geometry Text { string "hello" fontStyle FontStyle { family "SANS" } } appearance Appearance {
      texture PixelTexture { image 2 1 3 0xFF0000 0x00FF00 } textureTransform TextureTransform { scale 2 2 } } }
    Anchor { url "x" children Billboard { children Collision { collide FALSE children [ ] } } }
    EXTERNPROTO Far [ field SFBool a ] "far.wrl#Far" Far { a TRUE })"),
                               "r.wrl");
  EXPECT_EQ(1u, model.links.at(0).shapes.size());
}

TEST(VrmlReader, AcceptsCarriageReturnsAndAByteOrderMark) {
  std::string text = "\xEF\xBB\xBF" + robotWith("Nonsense { }");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  const auto model = parseVrml(text, "r.wrl");
  EXPECT_EQ(5, model.warnings.at(0).line);
}

TEST(VrmlReader, ReadsTheSameNumbersWhereTheDecimalPointIsAComma) {
  class Comma : public std::numpunct<char> {
   public:
    Comma() : std::numpunct<char>(1) {}
    char do_decimal_point() const override { return ','; }
  } comma;
  const std::string cLocale = std::setlocale(LC_ALL, nullptr);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), &comma));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where the machine has it
  const auto shapes = shapesOf("Shape { geometry Box { size 1.5 2.25 .125 } }");
  const auto model = parseVrml(robotWith(""), "r.wrl");
  const std::string table = describeModel(model);
  std::locale::global(before);
  std::setlocale(LC_ALL, cLocale.c_str());
  EXPECT_EQ(Vector3d(1.5, 2.25, 0.125), shapes.at(0).size_m);
  EXPECT_THAT(table, HasSubstr("1.0000 kg"));
}

}  // namespace
}  // namespace btr::test
