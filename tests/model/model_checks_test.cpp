// Semantic checks: one test for each rule, through the VRML reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/model/model_texts.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

std::string refusedSegment(const std::string& fields) {
  return vrmlRefusal(robotWithJoint("jointType \"rotate\"", fields));
}
std::string refusedJoint(const std::string& fields) { return vrmlRefusal(robotWithJoint(fields)); }

TEST(ModelChecks, AcceptTheSmallestRobot) {
  EXPECT_EQ("accepted", vrmlRefusal(robotWith("")));
  EXPECT_EQ("accepted", refusedSegment(goodMass));
}

TEST(ModelChecks, MassMustBePositive) {
  EXPECT_THAT(refusedSegment("mass 0"),
              HasSubstr("robot.wrl:5: link ARM: mass 0 kg is not allowed; 0.000001 to 1000000 kg"));
  EXPECT_THAT(refusedSegment("mass -1"), HasSubstr("mass -1 is not allowed; 0 or more"));
  EXPECT_THAT(vrmlRefusal(robotWithJoint("jointType \"rotate\" children Shape { }")), HasSubstr("twice"));
}

TEST(ModelChecks, NumbersAreThoseOfRobots) {
  const std::string inertia = " momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ]";
  EXPECT_THAT(refusedSegment("mass 1e300" + inertia),
              HasSubstr("link ARM: mass 1e+300 kg is not allowed; 0.000001 to 1000000"));
  EXPECT_THAT(refusedSegment("mass 1e-7" + inertia), HasSubstr("mass 1e-07 kg is not allowed"));
  EXPECT_THAT(refusedSegment("mass 1 momentsOfInertia [ 1e7 0 0 0 1e7 0 0 0 1e7 ]"),
              HasSubstr("link ARM: the inertia [kg m2] 10000000 is not allowed; -1000000 to 1000000"));
  EXPECT_THAT(refusedSegment("mass 1 centerOfMass 0 1e7 0" + inertia), HasSubstr("link ARM: the centre of mass [m]"));
  EXPECT_THAT(refusedJoint("jointType \"rotate\" maxTorque 1e7"),
              HasSubstr("the largest torque 10000000 is not allowed"));
  EXPECT_THAT(refusedJoint("jointType \"rotate\" gearRatio -1e7"), HasSubstr("the gear ratio -10000000"));
  EXPECT_THAT(refusedJoint("jointType \"rotate\" translation 1e30 0 0"), HasSubstr("its place [m]"));
  EXPECT_THAT(vrmlRefusal(robotWith("Shape { geometry Sphere { radius 1e30 } }")), HasSubstr("the size of a shape"));
}

TEST(ModelChecks, ABaseThatStandsInTheWorldNeedsNoMass) {
  EXPECT_EQ("accepted", vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody DEF A Joint { jointType \"fixed\" } }"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { skeleton DEF A Joint { jointType \"fixed\" } }"),
              testing::AllOf(HasSubstr("\"skeleton\", which is not allowed"), HasSubstr("\"humanoidBody\"")));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody DEF A Joint { jointType \"free\" } }"),
              HasSubstr("link A: mass 0"));
}

TEST(ModelChecks, InertiaMustHaveNineNumbers) {
  EXPECT_THAT(refusedSegment("mass 1 momentsOfInertia [ 1 1 1 ]"), HasSubstr("9 numbers"));
}

TEST(ModelChecks, InertiaMustBeSymmetric) {
  EXPECT_THAT(refusedSegment("mass 1 momentsOfInertia [ 1 0.1 0 0 1 0 0 0 1 ]"),
              HasSubstr("link ARM: the inertia must be symmetric"));
}

TEST(ModelChecks, InertiaMustBePositiveDefinite) {
  EXPECT_THAT(refusedSegment("mass 1"), HasSubstr("positive definite"));
  EXPECT_THAT(refusedSegment("mass 1 momentsOfInertia [ 1 2 0 2 1 0 0 0 1 ]"), HasSubstr("positive definite"));
  EXPECT_THAT(refusedSegment("mass 1 momentsOfInertia [ 1 0 0 0 1 0 0 0 -1 ]"), HasSubstr("positive definite"));
}

TEST(ModelChecks, MomentsThatNoBodyHasAreSaid) {
  const auto said = [](double largest) {
    RobotModel model;
    model.freeBase = true;
    Link link;
    link.name = "body";
    link.line = 7;
    link.inertial.mass_kg = 1;
    link.inertial.inertia_kg_m2 = Eigen::Vector3d(1e-6, 1e-6, largest).asDiagonal();
    model.links.push_back(link);
    checkModel(model, "made");
    return model.warnings;
  };
  EXPECT_TRUE(said(2e-6).empty()) << "a thin plate";
  const auto warnings = said(2.1e-6);
  ASSERT_EQ(1u, warnings.size());
  EXPECT_THAT(warnings[0].text, HasSubstr("link body: the inertia violates the triangle inequality"));
  EXPECT_EQ(7, warnings[0].line);
  EXPECT_EQ(Warning::Loss::inertia, warnings[0].loss);
}

TEST(ModelChecks, LimitsMustBeInOrder) {
  EXPECT_THAT(refusedJoint("jointType \"rotate\" llimit 1 ulimit -1"),
              HasSubstr("robot.wrl:4: joint HINGE: limits 1 and -1"));
  EXPECT_THAT(refusedJoint("jointType \"slide\" llimit 1 ulimit 0"), HasSubstr("the lower must be less"));
}

TEST(ModelChecks, AxesNeedADirection) {
  EXPECT_EQ("accepted", refusedJoint("jointType \"rotate\" jointAxis 0 0 2"));
  EXPECT_THAT(refusedJoint("jointType \"rotate\" jointAxis 0 0 0"), HasSubstr("unit vector"));
  EXPECT_EQ("accepted", refusedJoint("jointType \"rotate\" jointAxis 0.577 0.577 0.577"))
      << "three digits are made exact";
}

TEST(ModelChecks, NamesAndIdsMustBeUnique) {
  const auto twins = [](const std::string& a, const std::string& b) {
    return vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody DEF ROOT Joint { children [ DEF BASE Segment { " +
                       goodMass + " }\n" + a + "\n" + b + " ] } }");
  };
  const auto joint = [](const std::string& name, const std::string& link, const std::string& id) {
    return "DEF " + name + " Joint { jointType \"rotate\" jointId " + id + " children DEF " + link + " Segment { " +
           goodMass + " } }";
  };
  EXPECT_EQ("accepted", twins(joint("A", "LA", "-1"), joint("B", "LB", "-1")));
  EXPECT_THAT(twins(joint("A", "LA", "1"), joint("A", "LB", "2")),
              HasSubstr("robot.wrl:4: a second joint \"A\" is not allowed; the first is in line 3"));
  EXPECT_THAT(twins(joint("A", "LA", "1"), joint("B", "LA", "2")), HasSubstr("a second link \"LA\""));
  EXPECT_THAT(twins(joint("A", "LA", "1"), joint("B", "LB", "1")), HasSubstr("a second joint with jointId \"1\""));
  EXPECT_THAT(twins(joint("A", "LA", "1"), "USE A"), HasSubstr("a second"));
  EXPECT_THAT(twins("DEF S Gyro { }", "DEF S ForceSensor { }"), HasSubstr("a second sensor \"S\""));
}

TEST(ModelChecks, JointsNeedANameAndAKnownType) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody Joint { } }"), HasSubstr("a Joint needs a name"));
  EXPECT_THAT(refusedJoint("jointType \"ball\""),
              HasSubstr("jointType \"ball\" is not allowed; \"rotate\", \"slide\" or \"fixed\""));
  EXPECT_THAT(refusedJoint(""), HasSubstr("jointType \"\" is not allowed"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody DEF A Joint { jointType \"rotate\" } }"),
              HasSubstr("of the root Joint A"));
}

TEST(ModelChecks, ThereIsOneRobotWithOneRoot) {
  const std::string root = "Joint { children Segment { " + goodMass + " } }";
  EXPECT_THAT(vrmlRefusal(vrmlHeader), HasSubstr("no Humanoid"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { }"), HasSubstr("no Joint"));
  EXPECT_THAT(vrmlRefusal(robotWith("") + "Humanoid { }"), HasSubstr("a second Humanoid"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody [ DEF A " + root + " DEF B " + root + " ] }"),
              HasSubstr("a second root (Joint B"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Humanoid { humanoidBody Segment { } }"),
              HasSubstr("a Segment outside of a Joint"));
}

TEST(ModelChecks, NothingWithMassStandsBelowAScale) {
  EXPECT_THAT(vrmlRefusal(robotWith("Transform { scale 2 2 2 children DEF J Joint { jointType \"rotate\" } }")),
              HasSubstr("a Joint below a scale"));
  EXPECT_THAT(refusedJoint("jointType \"rotate\" scale -1 1 1"), HasSubstr("a Joint below a scale"));
}

TEST(ModelChecks, ServoNumbersAndSensorsHaveRanges) {
  EXPECT_THAT(refusedJoint("jointType \"rotate\" maxTorque -1"),
              HasSubstr("Joint.maxTorque -1 is not allowed; 0 or more"));
  EXPECT_THAT(vrmlRefusal(robotWith("VisionSensor { width 0 }")), HasSubstr("width and height from 1"));
  EXPECT_THAT(vrmlRefusal(robotWith("VisionSensor { fieldOfView 4 }")), HasSubstr("fieldOfView"));
  EXPECT_THAT(vrmlRefusal(robotWith("Shape { geometry Box { size 1 0 1 } }")),
              HasSubstr("Box.size must be greater than 0"));
  EXPECT_THAT(vrmlRefusal(robotWith("Shape { geometry Sphere { radius -1 } }")),
              HasSubstr("Sphere.radius must be greater than 0"));
}

TEST(ModelChecks, HoldForModelsMadeInMemory) {
  RobotModel model = parseVrml(robotWithJoint("jointType \"rotate\""), "robot.wrl");
  model.joints[0].parentLink = 1;
  EXPECT_THAT(refusal([&] { checkModel(model, "made"); }), HasSubstr("its parent link must come before it"));
  model.joints.clear();
  EXPECT_THAT(refusal([&] { checkModel(model, "made"); }), HasSubstr("2 links and 0 joints"));
}

TEST(DescribeModel, ListsLinksJointsMassesAndWarningsWithLines) {
  const auto text =
      robotWithJoint("jointType \"rotate\" jointAxis 0 1 0 llimit -0.5 ulimit 1.0471976 pGain 2.5",
                     "mass 0.25 centerOfMass 0 0 -2 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ] children Odd { }");
  const std::string table = describeModel(parseVrml(text, "robot.wrl"));
  EXPECT_THAT(table, HasSubstr("robot  R  (free base)"));
  EXPECT_THAT(table, testing::ContainsRegex("ARM +BASE +0\\.2500 +0\\.0000 +0\\.0000 +-2\\.0000"));
  EXPECT_THAT(
      table,
      testing::ContainsRegex(
          "HINGE +ARM +rotate +0\\.000 +1\\.000 +0\\.000 +-0\\.5000 to +1\\.0472 rad \\( *-28\\.6 to +60\\.0 deg\\)"));
  EXPECT_THAT(table, HasSubstr("p 2.500"));
  // (1·0 + 0.25·(-2)) / 1.25
  EXPECT_THAT(table, HasSubstr("2 links, 1 joints (1 moving), 1.2500 kg, centre of mass (0.0000, 0.0000, -0.4000) m"));
  EXPECT_THAT(table, HasSubstr("line 5: the node Odd is not known"));
  EXPECT_THAT(table, testing::Not(HasSubstr("default servo")));
}

TEST(DescribeModel, NamesTheJointsThatGetTheDefaultServo) {
  EXPECT_THAT(describeModel(parseVrml(robotWithJoint("jointType \"rotate\""), "robot.wrl")),
              HasSubstr("1 joint has no gains in the file and gets the default servo's, p 7.5 and d 0.05: HINGE"));
}

TEST(DescribeModel, NamesNumbersOfSlideJointsInTheirUnitsAndShowsRotors) {
  const std::string table = describeModel(parseVrml(
      robotWithJoint("jointType \"slide\" llimit -1 ulimit 1 pGain 2 maxTorque 3 coulombFriction 0.5 rotorInertia 2e-7 "
                     "gearRatio 100"),
      "robot.wrl"));
  EXPECT_THAT(table, HasSubstr("-1.0000 to  1.0000 m"));
  for (const char* number :
       {"max_force_n 3.000", "coulomb_friction_n 0.5000", "rotor_inertia_kg_m2 2e-07", "gear_ratio 100"})
    EXPECT_THAT(table, HasSubstr(number));
}

TEST(Model, LimitsThatLookLikeDegreesAreSaid) {
  const RobotModel model = parseVrml(robotWithJoint("jointType \"rotate\" llimit -46 ulimit 46 pGain 2"), "robot.wrl");
  EXPECT_THAT(describeModel(model), HasSubstr("-46.0000 to 46.0000 rad (-2635.6 to 2635.6 deg)"));
  EXPECT_THAT(describeModel(model), HasSubstr("joint HINGE: the limits -46 to 46 look like degrees; they are taken as "
                                              "radians"));
  for (const char* limits : {"llimit -7 ulimit 7", "llimit -10000 ulimit 10000", ""})
    EXPECT_TRUE(
        parseVrml(robotWithJoint("jointType \"rotate\" pGain 2 " + std::string(limits)), "r.wrl").warnings.empty())
        << limits;
}

}  // namespace
}  // namespace btr::test
