// The URDF reader: what it makes of files, and which it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "core/spec/random.h"
#include "tests/model/model_texts.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::string link(const std::string& name, const std::string& more = "", const std::string& mass = "1") {
  return "<link name='" + name + "'><inertial><mass value='" + mass +
         "'/><inertia ixx='1' iyy='1' izz='1'/></inertial>" + more + "</link>\n";
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& type = "revolute",
                  const std::string& more = "<limit lower='-1' upper='1' effort='2' velocity='3'/>") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         more + "</joint>\n";
}
std::string robot(const std::string& inside) {
  return "<?xml version='1.0'?>\n<robot name='r'>\n" + inside + "</robot>\n";
}
RobotModel read(const std::string& inside) { return parseUrdf(robot(inside), "robot.urdf"); }
std::string refused(const std::string& inside) { return urdfRefusal(robot(inside)); }

TEST(Urdf, ReadsLinksAndJointsFromTheRootOn) {
  const auto model = read(joint("knee", "upper", "lower") + link("lower") +
                          joint("hip", "base", "upper", "continuous",
                                "<origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><axis xyz='0 -1 0'/>") +
                          link("upper") + link("base", "", "2.5"));
  EXPECT_EQ("r", model.name);
  EXPECT_TRUE(model.freeBase);
  ASSERT_EQ(3u, model.links.size());
  EXPECT_EQ("base", model.links[0].name);
  EXPECT_DOUBLE_EQ(2.5, model.links[0].inertial.mass_kg);
  EXPECT_EQ("hip", model.joints[0].name);
  EXPECT_EQ(Vector3d(0, -1, 0), model.joints[0].axis);
  EXPECT_LT(model.joints[0].lower, -1e8);
  EXPECT_TRUE(model.joints[0].origin.isApprox(
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()), 1e-12));
  EXPECT_EQ(1, model.joints[1].parentLink);
  EXPECT_EQ(Vector3d::UnitX(), model.joints[1].axis);
  EXPECT_EQ(2, model.joints[1].servo.maxTorque_nm);
  EXPECT_EQ(3, model.joints[1].speedLimit);
}

TEST(Urdf, ReadsDynamicsAndPrismaticJoints) {
  const auto model =
      read(link("a") + link("b") +
           joint("j", "a", "b", "prismatic", "<limit lower='0' upper='0.5'/><dynamics damping='0.1' friction='0.2'/>"));
  EXPECT_EQ(Joint::Type::slide, model.joints.at(0).type);
  EXPECT_EQ(0.5, model.joints[0].upper);
  EXPECT_EQ(0.1, model.joints[0].servo.viscousFriction_nm_s_rad);
  EXPECT_EQ(0.2, model.joints[0].servo.coulombFriction_nm);
}

TEST(Urdf, ReadsBoxesSpheresAndLyingCylinders) {
  const auto model =
      read("<material name='red'><color rgba='1 0 0 0.5'/></material>" +
           link("a",
                "<visual><geometry><box size='1 2 3'/></geometry><material name='red'/></visual>"
                "<collision><origin xyz='0 0 1'/><geometry><cylinder radius='0.5' length='4'/></geometry></collision>"
                "<collision><geometry><sphere radius='2'/></geometry></collision>"));
  const auto& shapes = model.links.at(0).shapes;
  ASSERT_EQ(3u, shapes.size());
  EXPECT_EQ(Vector3d(1, 2, 3), shapes[0].size_m);
  EXPECT_TRUE(shapes[0].drawn && !shapes[0].collides);
  EXPECT_THAT(shapes[0].colour, testing::ElementsAre(1.f, 0.f, 0.f, 0.5f));
  EXPECT_TRUE(shapes[1].collides && !shapes[1].drawn);
  EXPECT_EQ(Vector3d(0.5, 4, 0), shapes[1].size_m);
  // The cylinder's own y axis is URDF's z.
  EXPECT_TRUE((shapes[1].pose.linear() * Vector3d::UnitY()).isApprox(Vector3d::UnitZ(), 1e-12));
  EXPECT_EQ(Vector3d(0, 0, 1), shapes[1].pose.translation());
}

TEST(Urdf, TurnsTheInertiaIntoTheLinksFrame) {
  const auto model = read(
      "<link name='a'><inertial><origin xyz='0 0 1' rpy='1.5707963267948966 0 0'/><mass value='2'/>"
      "<inertia ixx='1' ixy='0' ixz='0' iyy='2' iyz='0' izz='2.5'/></inertial></link>");
  const Inertial& inertial = model.links.at(0).inertial;
  EXPECT_EQ(Vector3d(0, 0, 1), inertial.centreOfMass_m);
  EXPECT_TRUE(inertial.inertia_kg_m2.diagonal().isApprox(Vector3d(1, 2.5, 2), 1e-12));
}

TEST(Urdf, ARootWithoutMassIsAFixedBase) {
  const auto model = read("<link name='base'/>" + link("arm") + joint("j", "base", "arm"));
  EXPECT_FALSE(model.freeBase);
  EXPECT_EQ("base", model.links.at(0).name);
  EXPECT_EQ(2u, model.links.size());
}

TEST(Urdf, FramesWithoutMassAreJoinedToWhatTheyAreFixedTo) {
  const auto model =
      read(link("a") +
           "<link name='frame'><visual><origin xyz='0 1 0'/><geometry><sphere radius='1'/></geometry></visual></link>" +
           link("b") + joint("fix", "a", "frame", "fixed", "<origin xyz='1 0 0'/>") +
           joint("j", "frame", "b", "revolute", "<origin xyz='0 0 1'/><limit lower='-1' upper='1'/>"));
  ASSERT_EQ(2u, model.links.size());
  EXPECT_EQ(Vector3d(1, 0, 1), model.joints.at(0).origin.translation());
  EXPECT_EQ(Vector3d(1, 1, 0), model.links[0].shapes.at(0).pose.translation());
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("link frame was joined to a"));
}

TEST(Urdf, AFixedMassBelowAnEmptyRootIsTheBase) {
  const auto model =
      read("<link name='base_link'/>" + link("trunk", "", "3") + joint("fix", "base_link", "trunk", "fixed", ""));
  ASSERT_EQ(1u, model.links.size());
  EXPECT_EQ("base_link", model.links[0].name);
  EXPECT_EQ(3, model.links[0].inertial.mass_kg);
  EXPECT_TRUE(model.freeBase);
}

TEST(Urdf, AWorldWithAFloatingJointFreesTheBase) {
  const auto model = read("<link name='world'/>" + link("trunk") + joint("float", "world", "trunk", "floating", ""));
  ASSERT_EQ(1u, model.links.size());
  EXPECT_EQ("trunk", model.links[0].name);
  EXPECT_TRUE(model.freeBase);
  EXPECT_FALSE(read("<link name='world'/>" + link("trunk") + joint("fix", "world", "trunk", "fixed", "")).freeBase);
}

TEST(Urdf, IgnoresOtherElementsWithAWarning) {
  const auto model =
      read(link("a", "<visual><geometry><mesh filename='package://x.stl'/></geometry></visual>") + link("b") +
           "<gazebo/>\n" + joint("j", "a", "b", "revolute", "<limit lower='-1' upper='1'/><calibration/>"));
  ASSERT_EQ(3u, model.warnings.size());
  EXPECT_THAT(model.warnings[0].text, HasSubstr("link a: mesh \"package://x.stl\" was not read; it is not drawn"));
  EXPECT_THAT(model.warnings[1].text, HasSubstr("<gazebo>"));
  EXPECT_THAT(model.warnings[2].text, HasSubstr("<calibration>"));
  EXPECT_EQ(3, model.warnings[0].line);
}

TEST(Urdf, ReadsTheSameNumbersWhereTheDecimalPointIsAComma) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const bool comma = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  const auto model = read(link("a", "", "1.25"));
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(1.25, model.links.at(0).inertial.mass_kg) << "with de_DE: " << comma;
}

TEST(HostileUrdf, NestingIsRefused) {
  for (const std::size_t depth : {1000, 10'000, 100'000, 1'000'000}) {
    const std::string open = robot(repeated("<a>", depth));
    EXPECT_THAT(urdfRefusal(open), testing::AnyOf(HasSubstr("deeper than 100"), HasSubstr("elements are not allowed")))
        << depth;
    EXPECT_NE("accepted", urdfRefusal(robot(link("a", repeated("<a>", depth) + repeated("</a>", depth))))) << depth;
  }
}

TEST(HostileUrdf, NumbersMustBeFinite) {
  for (const std::string mass : {"abc", "nan", "inf", "1e999", "", "1 2", "1,5", "0x10"})
    EXPECT_THAT(refused(link("a", "", mass)), HasSubstr("robot.urdf:3: ")) << mass;
  EXPECT_THAT(refused(link("a", "", "abc")), HasSubstr("value=\"abc\" is not allowed; 1 finite number is expected"));
  EXPECT_THAT(refused(link("a") + link("b") + joint("j", "a", "b", "revolute", "<origin xyz='0 0'/>")),
              HasSubstr("3 finite numbers are expected"));
}

TEST(HostileUrdf, MassAndInertiaAreChecked) {
  EXPECT_THAT(refused(link("a", "", "-1")), HasSubstr("greater than 0"));
  EXPECT_THAT(refused("<link name='a'><inertial><mass value='1'/></inertial></link>"),
              HasSubstr("needs <mass> and <inertia>"));
  EXPECT_THAT(refused("<link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='0' izz='0'/></inertial></link>"),
              HasSubstr("positive definite"));
  EXPECT_THAT(refused(link("a") + "<link name='b'/>" + joint("j", "a", "b") + link("c") + joint("k", "b", "c")),
              HasSubstr("link b: mass 0"));
}

TEST(HostileUrdf, TheLinksMustFormOneTree) {
  EXPECT_THAT(refused(""), HasSubstr("no links"));
  EXPECT_THAT(refused(link("a") + link("b")), HasSubstr("a second root link \"b\""));
  EXPECT_THAT(refused(link("a") + link("b") + joint("j", "a", "b") + joint("k", "b", "a")), HasSubstr("cycle"));
  EXPECT_THAT(refused(link("r") + link("a") + link("b") + joint("j", "a", "b") + joint("k", "b", "a")),
              HasSubstr("cycle"));
  EXPECT_THAT(refused(link("a") + joint("j", "a", "a")), HasSubstr("cycle"));
  EXPECT_THAT(refused(link("a") + link("b") + link("c") + joint("j", "a", "c") + joint("k", "b", "c")),
              HasSubstr("a second parent"));
  EXPECT_THAT(refused(link("a") + joint("j", "a", "x")), HasSubstr("there is no link \"x\""));
}

TEST(HostileUrdf, NamesMustBeUniqueAndThere) {
  EXPECT_THAT(refused(link("a") + link("a")), HasSubstr("a second link \"a\""));
  EXPECT_THAT(refused(link("a") + link("b") + link("c") + joint("j", "a", "b") + joint("j", "a", "c")),
              HasSubstr("a second joint \"j\""));
  EXPECT_THAT(refused("<link/>"), HasSubstr("needs the attribute name"));
  EXPECT_THAT(refused(link(std::string(5000, 'x'))), HasSubstr("longer than 4096"));
}

TEST(HostileUrdf, JointsAreChecked) {
  const auto with = [](const std::string& type, const std::string& more) {
    return refused(link("a") + link("b") + joint("j", "a", "b", type, more));
  };
  EXPECT_THAT(with("revolute", "<limit lower='1' upper='-1'/>"), HasSubstr("the lower must be less than the upper"));
  EXPECT_THAT(with("revolute", "<axis xyz='0 0 0'/><limit lower='-1' upper='1'/>"), HasSubstr("unit vector"));
  EXPECT_THAT(with("planar", ""), HasSubstr("joint type \"planar\" is not allowed"));
  EXPECT_THAT(with("floating", ""), HasSubstr("floating is allowed only"));
  EXPECT_THAT(with("revolute", "<dynamics damping='-1'/>"), HasSubstr(": damping -1 is not allowed; 0 or more"));
  EXPECT_THAT(refused(link("a") + "<joint name='j' type='fixed'><parent link='a'/></joint>"),
              HasSubstr("needs a <child>"));
}

TEST(HostileUrdf, OtherDocumentsAreRefused) {
  const std::string plain = "<robot name='r'>" + link("a") + "</robot>";
  EXPECT_THAT(urdfRefusal("<!DOCTYPE robot [ <!ENTITY a 'aaaa'> ]>\n" + plain), HasSubstr("robot.urdf:1: "));
  EXPECT_THAT(urdfRefusal("<!DOCTYPE robot SYSTEM '/etc/passwd'>\n" + plain),
              HasSubstr("DOCTYPE and entities are not allowed"));
  EXPECT_THAT(urdfRefusal("<html/>"), HasSubstr("the outermost element must be <robot>"));
  for (const std::string text : {"", "robot", "<robot>", "<robot", "<robot></link>"})
    EXPECT_THAT(urdfRefusal(text), HasSubstr("robot.urdf:")) << text;
  EXPECT_THAT(urdfRefusal(std::string("<robot>\0</robot>", 16)), HasSubstr("control character"));
}

TEST(HostileUrdf, LimitsNameThemselves) {
  ModelBudget small;
  small.bytes = 50;
  EXPECT_THAT(urdfRefusal(robot(link("a")), small), HasSubstr("more than 50 bytes"));
  small = {};
  small.nodes = 10;
  EXPECT_THAT(urdfRefusal(robot(repeated("<gazebo/>", 30)), small), HasSubstr("more than 10 elements"));
}

TEST(HostileUrdf, LongChainsAreReadWithoutRecursion) {
  std::string text = link("l0");
  for (int i = 1; i < 20'000; ++i)
    text += link("l" + std::to_string(i)) +
            joint("j" + std::to_string(i), "l" + std::to_string(i - 1), "l" + std::to_string(i));
  EXPECT_EQ(20'000u, read(text).links.size());
}

TEST(HostileUrdf, ADamagedFileIsReadOrRefusedButNeverMore) {
  const std::string whole =
      robot(link("a", "<visual><geometry><box size='1 2 3'/></geometry></visual>") + link("b") + joint("j", "a", "b"));
  Random random(7);
  int refusals = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = whole;
    for (int change = 0; change < 2; ++change) {
      const std::size_t at = random.below(text.size());
      if (random.chance(0.5))
        text[at] = static_cast<char>(random.below(256));
      else
        text.erase(at, 1 + random.below(10));
    }
    refusals += urdfRefusal(text) != "accepted";
  }
  EXPECT_GT(refusals, 1000);
  EXPECT_LT(refusals, 2000);
}

}  // namespace
}  // namespace btr::test
