// From sources to a stick: stubs, lists, paths, and what a compiler of 2003 let pass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/openr/builder/build_hint.h"
#include "core/openr/builder/kit_paths.h"
#include "core/openr/builder/merged_config.h"
#include "core/openr/builder/object_settings.h"
#include "core/openr/builder/stick_builder.h"
#include "core/openr/builder/stub_generator.h"
#include "core/openr/robot_design.h"
#include "core/openr/stick_config.h"
#include "core/spec/error.h"
#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const char* const good = R"(// a comment
# and another one

ObjectName : Thing
NumOfOSubject : 1
NumOfObserver : 2
Service : "Other.Out.Type.S", null, Ready()
Service : "Thing.In.Type.O", Connect(), Notify()
Service : "Thing.Out.Type.O", null, null
Extra : Timer()
)";

std::string refusal(const std::string& text) {
  try {
    stubConfigFrom(text, "stub.cfg");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = good;
  return text.replace(text.find(from), from.size(), to);
}

TEST(StubGenerator, ReadsNamesAndMethods) {
  const StubConfig config = stubConfigFrom(good, "stub.cfg");
  EXPECT_EQ(config.object, "Thing");
  ASSERT_EQ(config.subjects.size(), 1u);
  EXPECT_EQ(config.subjects[0].name, "Other.Out.Type.S");  // connections go by this name
  EXPECT_EQ(config.subjects[0].first, "");
  EXPECT_EQ(config.subjects[0].second, "Ready");
  ASSERT_EQ(config.observers.size(), 2u);
  EXPECT_EQ(config.observers[0].first, "Connect");
  EXPECT_THAT(config.extras, ElementsAre("Timer"));
}

TEST(StubGenerator, NumbersEntriesInOrder) {
  const auto files = stubFiles(stubConfigFrom(good, "stub.cfg"));
  const std::string entry = files.at("entry.h"), def = files.at("def.h"), stub = files.at("ThingStub.cc");
  EXPECT_THAT(entry, HasSubstr("Entry_Control[] = {4}"));
  EXPECT_THAT(entry, HasSubstr("Entry_Ready[] = {5}"));
  EXPECT_THAT(entry, HasSubstr("Entry_Connect[] = {6, 7}"));
  EXPECT_THAT(entry, HasSubstr("Entry_Notify[] = {8, 9}"));
  EXPECT_THAT(entry, HasSubstr("numOfBasicEntries = 10"));
  EXPECT_THAT(entry, HasSubstr("Extra_Entry[] = {10}"));
  EXPECT_THAT(entry, HasSubstr("entryTimer = 0"));
  EXPECT_THAT(def, HasSubstr("sbjOut = 0"));
  EXPECT_THAT(def, HasSubstr("obsOut = 1"));
  EXPECT_THAT(stub, HasSubstr("Self.Notify(event)"));
}

TEST(StubGenerator, RefusesWithLineValueAndWhatIsAllowed) {
  EXPECT_THAT(refusal(changed("Ready()", "Ready")),
              HasSubstr("stub.cfg:7: Service: \"Ready\" is not allowed; null or"));
  EXPECT_THAT(refusal(changed("NumOfOSubject : 1", "NumOfOSubject : 0")),
              HasSubstr("stub.cfg:5: NumOfOSubject: \"0\""));
  EXPECT_THAT(refusal(changed("NumOfOSubject : 1", "NumOfOSubject : 2")),
              HasSubstr("NumOfOSubject: 2 is not allowed; 1"));
  EXPECT_THAT(refusal(changed("Thing.In.Type.O", "Thing.In.O")), HasSubstr("stub.cfg:8: Service: \"Thing.In.O\""));
  EXPECT_THAT(refusal(changed("ObjectName : Thing", "")), HasSubstr("ObjectName is missing"));
  EXPECT_THAT(refusal(changed("Thing.Out.Type.O", "Thing.In.Type.O")), HasSubstr("that no other one has"));
  EXPECT_THAT(refusal(changed("Extra : Timer()", "Extra : null")), HasSubstr("stub.cfg:10: Extra"));
  const char* const lines = "is not allowed; ObjectName, NumOfOSubject, NumOfOObserver, Service or Extra";
  EXPECT_THAT(refusal(changed("NumOfObserver", "NumOfObservers")),
              HasSubstr("stub.cfg:6: \"NumOfObservers\" " + std::string(lines)));
  EXPECT_THAT(refusal(good + std::string("something else\n")),
              HasSubstr("stub.cfg:11: \"something else\" " + std::string(lines)));
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(refusal("/* Copyright: ours\n * Extra : no\n */\n" + std::string(good) + "/* Extra : neither"), "");
}

TEST(ObjectSettings, AreOneLineBesideComments) {
  const auto said = [](const std::string& text) {
    try {
      return objectLineOf(text, "thing.ocf");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  const std::string line = "object Thing 3072 16384 128 cache tlb user";
  EXPECT_EQ(said("# of Thing\n\n" + line + "\n// end\n"), line);
  EXPECT_EQ(said("/* of\n Thing */" + line + "/**/// end"), line);
  EXPECT_THAT(said("/* two\n lines */\nfoo\n"), HasSubstr("thing.ocf:3: \"foo\""));
  EXPECT_EQ(said("object \"Thing\" 3072 16384 128 cache tlb user\r\n"), line);
  EXPECT_EQ(said(""), "");
  EXPECT_THAT(said(line + "\nfoo bar\n"),
              HasSubstr("thing.ocf:2: \"foo bar\" is not allowed; object NAME STACK HEAP PRIORITY"));
  EXPECT_THAT(said("object Thing 3072 big 128\n"), HasSubstr("thing.ocf:1: \"object Thing 3072 big 128\""));
  EXPECT_THAT(said(line + "\n" + line), HasSubstr("thing.ocf:2: a second object is not allowed; one is"));
}

TEST(RobotDesigns, EveryPlaceOfTheSensorVectorIsAJointOrSensor) {
  for (const char* name : {"ERS-7", "ERS-210", "ERS-220"}) {
    const RobotDesign& design = robotDesign(name);
    for (const std::string& locator : design.sensorVector) {
      int found = 0;
      for (const auto* list : {&design.joints, &design.sensors})
        for (const Primitive& primitive : *list) found += primitive.locator == locator ? 1 : 0;
      EXPECT_EQ(found, 1) << name << " " << locator;
    }
  }
  EXPECT_EQ(robotDesign("ERS-7").sensorVector.size(), 34u);
  EXPECT_EQ(robotDesign("ERS-210").sensorVector.size(), 31u);
  EXPECT_EQ(robotDesign("ERS-220").sensorVector.size(), 31u);
  const RobotDesign& seven = robotDesign("ERS-7");
  EXPECT_EQ(seven.joints.size() + seven.sensors.size() + seven.lamps.size() + seven.others.size(), 65u);
  EXPECT_THROW(robotDesign("ERS-8"), InputError);
}

// Programs of teams index the vector by numbers. Those of the ERS-7 are Tekkotsu's (ERS7Info.h, "CPC IDs") and
// rUNSWift's (sensors.h of 2005), those of the others Sony's and Tekkotsu's.
TEST(RobotDesigns, TheSensorVectorHasTheOrderThatProgramsOfTeamsCountOn) {
  const std::pair<std::size_t, const char*> ofSeven[] = {{0, "PRM:/r1/c1/c2/c3/c4-Joint2:14"},  // mouth
                                                         {1, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"},
                                                         {2, "PRM:/r1/c1/c2/c3-Joint2:13"},  // head tilt
                                                         {3, "PRM:/r1/c1/c2/c3/t1-Sensor:t1"},
                                                         {4, "PRM:/r1/c1/c2/c3/p1-Sensor:p1"},
                                                         {5, "PRM:/r1/c1/c2/c3/p2-Sensor:p2"},
                                                         {6, "PRM:/r1/c1/c2-Joint2:12"},
                                                         {7, "PRM:/r1/c1-Joint2:11"},  // neck
                                                         {8, "PRM:/r2/c1/c2/c3/c4-Sensor:24"},
                                                         {9, "PRM:/r2/c1/c2/c3-Joint2:23"},
                                                         {10, "PRM:/r2/c1/c2-Joint2:22"},
                                                         {11, "PRM:/r2/c1-Joint2:21"},
                                                         {12, "PRM:/r3/c1/c2/c3/c4-Sensor:34"},
                                                         {16, "PRM:/r4/c1/c2/c3/c4-Sensor:44"},
                                                         {19, "PRM:/r4/c1-Joint2:41"},
                                                         {23, "PRM:/r5/c1-Joint2:51"},
                                                         {24, "PRM:/r6/c1-Joint2:61"},  // tail tilt
                                                         {25, "PRM:/r6/c2-Joint2:62"},
                                                         {26, "PRM:/a1-Sensor:a1"},
                                                         {28, "PRM:/a3-Sensor:a3"},
                                                         {29, "PRM:/p1-Sensor:p1"},
                                                         {30, "PRM:/b1-Sensor:b1"},
                                                         {31, "PRM:/t2-Sensor:t2"},
                                                         {33, "PRM:/t4-Sensor:t4"}};
  for (const auto& [place, locator] : ofSeven) EXPECT_EQ(robotDesign("ERS-7").sensorVector.at(place), locator);
  const std::pair<std::size_t, const char*> ofTwoTen[] = {
      {3, "PRM:/r1/c1/c2/c3/f1-Sensor:f1"}, {5, "PRM:/r1/c1/c2/c3/p1-Sensor:p1"},
      {6, "PRM:/r1/c1/c2/c3/c4-Joint2:j4"}, {7, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"},
      {8, "PRM:/r2/c1-Joint2:j1"},          {23, "PRM:/r5/c1/c2/c3/c4-Sensor:s4"},
      {26, "PRM:/r6/t1-Sensor:t1"},         {30, "PRM:/a3-Sensor:a3"}};
  for (const auto& [place, locator] : ofTwoTen) EXPECT_EQ(robotDesign("ERS-210").sensorVector.at(place), locator);
  const std::pair<std::size_t, const char*> ofTwoTwenty[] = {
      {3, "PRM:/r1/c1/c2/c3/p1-Sensor:p1"}, {6, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"},
      {7, "PRM:/r2/c1-Joint2:j1"},          {23, "PRM:/r6/t1-Sensor:t1"},
      {25, "PRM:/r6/s2-Sensor:s2"},         {28, "PRM:/a1-Sensor:a1"}};
  for (const auto& [place, locator] : ofTwoTwenty) EXPECT_EQ(robotDesign("ERS-220").sensorVector.at(place), locator);
}

TEST(StickConfig, SectionsHoldForOneRobot) {
  const std::string text = "# list\n/MS/A.BIN # first\n[ERS-7]\n/MS/SEVEN.BIN\n[ERS-210]\n/MS/OTHER.BIN\n";
  EXPECT_THAT(configLines(text, "ERS-7"), ElementsAre(ElementsAre("/MS/A.BIN"), ElementsAre("/MS/SEVEN.BIN")));
  EXPECT_THAT(configLines(text, "ERS-220"), ElementsAre(ElementsAre("/MS/A.BIN")));
}

TEST(StickConfig, ListsAreJoinedWithoutRepetition) {
  EXPECT_EQ(mergedConfig("a\nb\n[ERS-7]\nc\n", "b\r\nd\n[ERS-210]\ne\n[ERS-7]\nc\nf\n"),
            "a\nb\nd\n[ERS-7]\nc\nf\n[ERS-210]\ne\n");
}

TEST(StickPaths, StayOnTheStick) {
  const std::string folder = emptyFolder("paths"), stick = folder + "/MS";
  std::filesystem::create_directories(stick + "/OPEN-R/Data");
  writeText(stick + "/OPEN-R/Data/a.Txt", "x");
  writeText(folder + "/secret.txt", "x");
  std::filesystem::create_directory_symlink(folder, stick + "/OUT");
  std::filesystem::create_symlink("OPEN-R/Data/a.Txt", stick + "/IN");
  EXPECT_EQ(onStick(stick, "/MS/OPEN-R/Data/a.Txt"), stick + "/OPEN-R/Data/a.Txt");
  EXPECT_EQ(onStick(stick, "/ms/open-r/DATA/A.TXT"), stick + "/OPEN-R/Data/a.Txt");
  EXPECT_EQ(onStick(stick, "/MS//OPEN-R/./DATA/new.txt"), stick + "/OPEN-R/Data/NEW.TXT");
  EXPECT_EQ(onStick(stick, "/MS/IN"), stick + "/IN");
  for (const char* outside : {"/MS/../secret.txt", "/MS/OPEN-R/../../secret.txt", "/MS/OUT/secret.txt", "/MS/OUT",
                              "/MSX", "/etc/passwd", "secret.txt", "", "MS/a", "/MS/.."})
    EXPECT_EQ(onStick(stick, outside), "") << outside;
}

TEST(StickBuilder, TwoFoldersOntoOneStick) {
  const std::string out = emptyFolder("two") + "/MS";
  const StickBuild build = buildOnto(out, {programFolder("talk"), programFolder("names")});
  EXPECT_TRUE(build.complete());
  EXPECT_TRUE(build.absent.empty());
  EXPECT_EQ(stickConfig(out, "ERS-7").objects.size(), 3u);
  EXPECT_EQ(stickConfig(out, "ERS-7").connections.size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(programFolder("talk") + "/Sink/def.h"));  // sources stay as they are
}

TEST(StickBuilder, FollowsMakefilesAndTheirLibraries) {
  EXPECT_THAT(runStick(stickOf("ruled"), 3).all(), HasSubstr("Ruled: the answer is 42, by rule 3\n"));
}

TEST(StickBuilder, AStubByHandAndAMakefileWithoutInstall) {
  EXPECT_THAT(runStick(stickOf("hand"), 12).all(), HasSubstr("hand: by hand 2\n"));
}

TEST(StickBuilder, WithoutAMakefilePartsThatNobodyAsksForNeedNotCompile) {
  const StickBuild build = buildOnto(emptyFolder("parts"), {programFolder("ancient")});
  ASSERT_EQ(build.objects.size(), 1u);
  EXPECT_EQ(build.objects[0].said, "");
  EXPECT_EQ(build.objects[0].modules, std::vector<std::string>{"ANCIENT.BIN"});
}

TEST(StickBuilder, SaysWhatTheCompilerSays) {
  const std::string folder = emptyFolder("wrong");
  std::filesystem::create_directories(folder + "/Thing");
  writeText(folder + "/Thing/stub.cfg",
            "ObjectName : Thing\nNumOfOSubject : 1\nNumOfOObserver : 1\nService : \"Thing.A.B.S\", null, null\n"
            "Service : \"Thing.A.B.O\", null, null\n");
  writeText(folder + "/Thing/Thing.h", "#include <OPENR/OObject.h>\nclass Thing : public OObject { this is wrong };\n");
  const StickBuild build = buildOnto(emptyFolder("wrong_out"), {folder});
  ASSERT_EQ(build.objects.size(), 1u);
  EXPECT_FALSE(build.complete());
  EXPECT_THAT(build.objects[0].said, HasSubstr("Thing.h:2:"));
}

TEST(KitPaths, AreThoseThatEndWithItsName) {
  for (const char* kit : {"/usr/local/OPEN_R_SDK", "/usr/local/OPEN_R_SDK/", "$(HOME)/aibo/OPEN_R_SDK",
                          "/opt/OPENR_SDK", "/usr/local/OPEN_R_SDK-1.1.5"})
    EXPECT_TRUE(isKitFolder(kit)) << kit;
  for (const char* other :
       {"", "/usr/local", "OPEN_R_SDK", "/usr/local/OPEN_R_SDK/bin", "/usr/OPEN_R_SDKS", "/MY_OPEN_R_SDK"})
    EXPECT_FALSE(isKitFolder(other)) << other;
  EXPECT_EQ(withKitAt("P=/usr/local/OPEN_R_SDK\nG=${P}/a -I/usr/local/OPEN_R_SDK/OPEN_R\nH=$(HOME)/OPENR_SDK\n", "/k$"),
            "P=/k$$\nG=${P}/a -I/k$$/OPEN_R\nH=/k$$\n");
}

TEST(StickBuilder, AKitThatMakefilesWriteDownAndAStickThatIsNotHere) {
  // The whole team's folder; its lists lie in a folder of their own.
  EXPECT_THAT(runStick(stickOf("prefixed"), 3).all(), HasSubstr("Barker: woof\n"));
  // One object alone, whose Makefile includes what stands beside its folder.
  const StickBuild alone = buildOnto(emptyFolder("prefixed_alone"), {programFolder("prefixed") + "/barker"});
  ASSERT_EQ(alone.objects.size(), 1u);
  EXPECT_THAT(alone.objects[0].modules, ElementsAre("BARKER.BIN"));
}

TEST(StickBuilder, SaysWhichFileOfAMakefileIsMissing) {
  const std::string folder = emptyFolder("lacking");
  std::filesystem::create_directories(folder + "/Thing");
  writeText(folder + "/Thing/thing.ocf", "object Thing 8192 65536 128 cache tlb user\n");
  writeText(folder + "/Thing/Makefile",
            "ThingStub.cc: stub.cfg\n\t$(OPENRSDK_ROOT)/OPEN_R/bin/stubgen2 stub.cfg\ninstall: ThingStub.cc\n"
            "\t$(OPENRSDK_ROOT)/OPEN_R/bin/mkbin -o thing.bin ThingStub.cc\n");
  const StickBuild build = buildOnto(emptyFolder("lacking_out"), {folder});
  ASSERT_EQ(build.objects.size(), 1u);
  EXPECT_EQ(buildHint(build.objects[0].said),
            "stub.cfg is missing, which its Makefile needs: it names the object, its subjects and its observers");
  EXPECT_EQ(buildHint("make: *** No rule to make target '../makefile.config'.  Stop.\n"),
            "../makefile.config is missing, which its Makefile needs");
  EXPECT_THAT(buildHint("Thing.h:2:1: error: wrong\n"), HasSubstr("mend what the compiler says above"));
}

TEST(StickBuilder, TakesModulesThatAMakefilePutsOntoAStickBesideIt) {
  const std::string folder = emptyFolder("beside");
  for (const char* part : {"/Thing", "/obj", "/MS/OPEN-R/MW/CONF"}) std::filesystem::create_directories(folder + part);
  writeText(
      folder + "/Thing/Thing.h",
      "#include <OPENR/OObject.h>\n#include \"def.h\"\nclass Thing : public OObject { public: OSubject* subject[1]; "
      "OObserver* observer[1]; };\n");
  writeText(folder + "/Thing/stub.cfg",
            "ObjectName : Thing\nNumOfOSubject : 1\nNumOfOObserver : 1\nService : \"Thing.A.B.S\", null, null\n"
            "Service : \"Thing.A.B.O\", null, null\n");
  writeText(folder + "/Thing/Makefile",
            "install:\n\t$(OPENRSDK_ROOT)/OPEN_R/bin/stubgen2 stub.cfg\n"
            "\t$(OPENRSDK_ROOT)/bin/mipsel-linux-g++ -I. -I$(OPENRSDK_ROOT)/OPEN_R/include -c ThingStub.cc -o "
            "../obj/stub.o\n\t$(OPENRSDK_ROOT)/OPEN_R/bin/mkbin -o ../obj/t.bin ../obj/stub.o\n"
            "\tgzip -c ../obj/t.bin > ../MS/OPEN-R/MW/OBJS/THINGX.BIN\n");
  writeText(folder + "/obj/keep", "");
  // Without the folder that modules are copied to: version control keeps no empty one.
  writeText(folder + "/MS/OPEN-R/MW/CONF/OBJECT.CFG", "/MS/OPEN-R/MW/OBJS/THINGX.BIN\n");
  const std::string out = emptyFolder("beside_out");
  const StickBuild build = buildOnto(out, {folder});
  ASSERT_EQ(build.objects.size(), 1u);
  EXPECT_EQ(build.objects[0].said, "");
  EXPECT_THAT(build.objects[0].modules, ElementsAre("THINGX.BIN"));
}

TEST(StickBuilder, SaysWhatTheCompilerRefusedOfALibrary) {
  const std::string folder = emptyFolder("library");
  for (const char* part : {"/shared", "/Thing"}) std::filesystem::create_directories(folder + part);
  writeText(folder + "/shared/tool.cc", "int tool() { return nowhere; }\n");
  writeText(folder + "/shared/Makefile",
            "libtool.a: tool.cc\n\t$(OPENRSDK_ROOT)/bin/mipsel-linux-g++ -c tool.cc -o tool.o\n"
            "\t$(OPENRSDK_ROOT)/bin/mipsel-linux-ar rc libtool.a tool.o\n");
  writeText(folder + "/Thing/thing.ocf", "object Thing 8192 65536 128 cache tlb user\n");
  writeText(folder + "/Thing/Makefile",
            "install: ../shared/libtool.a\n\t$(OPENRSDK_ROOT)/OPEN_R/bin/mkbin -o thing.bin ../shared/libtool.a\n");
  const StickBuild build = buildOnto(emptyFolder("library_out"), {folder});
  ASSERT_EQ(build.objects.size(), 1u);
  EXPECT_FALSE(build.complete());
  EXPECT_THAT(build.objects[0].said, HasSubstr("tool.cc:1:"));
  EXPECT_THAT(build.objects[0].said, HasSubstr("nowhere"));
}

TEST(StickBuilder, RefusesFoldersWithoutObjects) {
  EXPECT_THROW(buildOnto(emptyFolder("nothing_out"), {emptyFolder("nothing")}), InputError);
}

}  // namespace
}  // namespace btr::openr
