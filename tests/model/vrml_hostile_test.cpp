// Files that want to crash, hang or fill the memory: each is refused with one message, or read within the budget.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "tests/model/model_texts.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

class Nesting : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(HostileVrml, Nesting, testing::Values(1000, 10'000, 100'000, 1'000'000));

TEST_P(Nesting, OfNodesIsRefused) {
  const auto text = robotWith("", repeated("Group { children [ ", GetParam()) + repeated("] } ", GetParam()));
  EXPECT_THAT(vrmlRefusal(text), HasSubstr("robot.wrl:2: nodes deeper than 200 are not allowed"));
}

TEST_P(Nesting, WithoutEndIsRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + repeated("Group { children ", GetParam())), HasSubstr("deeper than 200"));
}

TEST_P(Nesting, InsideAnUnknownNodeIsRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Odd { " + repeated("a { ", GetParam())), HasSubstr("deeper than 200"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Odd " + repeated("{ [ ", GetParam())), HasSubstr("deeper than 200"));
}

TEST_P(Nesting, OfProtosIsRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + repeated("PROTO A [ ] { ", GetParam())), HasSubstr("deeper than 200"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + repeated("PROTO A [ field SFNode x Group { children ", GetParam())),
              HasSubstr("is not allowed"));
}

TEST_P(Nesting, ByUseOfTheNodeBeforeIsRefused) {
  std::string text = "DEF N0 Group { }\n";
  for (std::size_t i = 1; i < std::min<std::size_t>(GetParam(), 150'000); ++i)
    text += "DEF N" + std::to_string(i) + " Group { children USE N" + std::to_string(i - 1) + " }\n";
  EXPECT_THAT(vrmlRefusal(vrmlHeader + text), HasSubstr("robot.wrl:202: nodes deeper than 200"));
}

TEST(HostileVrml, RecursiveProtoSeesNothingOfItself) {
  const auto model = parseVrml(robotWith("Loop { }", "PROTO Loop [ ] { Group { children Loop { } } }"), "robot.wrl");
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("the node Loop is not known"));
}

TEST(HostileVrml, MutuallyRecursiveProtosEndAtTheFirst) {
  const auto model =
      parseVrml(robotWith("B { }", "PROTO A [ ] { Group { children B { } } }\nPROTO B [ ] { A { } }"), "robot.wrl");
  ASSERT_EQ(1u, model.warnings.size());
  EXPECT_EQ(2, model.warnings[0].line);
}

TEST(HostileVrml, ProtoLaughsRunIntoTheNodeBudget) {
  std::string text = "PROTO P0 [ ] { Shape { geometry Box { } } }\n";
  for (int i = 1; i <= 25; ++i) {
    const std::string before = "P" + std::to_string(i - 1) + " { } ";
    text += "PROTO P" + std::to_string(i) + " [ ] { Group { children [ " + before + before + "] } }\n";
  }
  EXPECT_THAT(vrmlRefusal(robotWith("P25 { }", text)), HasSubstr("more than 200000 nodes are not allowed"));
}

TEST(HostileVrml, UseLaughsRunIntoTheNodeBudget) {
  std::string text = "DEF L0 Group { }\n";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = "USE L" + std::to_string(i - 1) + " ";
    text += "DEF L" + std::to_string(i) + " Group { children [ " + before + before + "] }\n";
  }
  EXPECT_THAT(vrmlRefusal(robotWith(text)), HasSubstr("more than 200000 nodes are not allowed"));
}

TEST(HostileVrml, TrianglesAreCountedOverTheWholeFile) {
  std::string points, faces;
  for (int i = 0; i < 3000; ++i) {
    points += std::to_string(i % 50) + " " + std::to_string(i / 50) + " 0 ";
    faces += std::to_string(i) + " ";
  }
  const std::string shape = "DEF S Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points +
                            " ] } coordIndex [ " + faces + " ] } } ";
  EXPECT_THAT(vrmlRefusal(robotWith(shape + repeated("USE S ", 1000))),
              HasSubstr("more than 2000000 triangles in the file"));
}

TEST(HostileVrml, UseInsideItsOwnNodeIsRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "DEF A Group {\n children USE A }"),
              HasSubstr("robot.wrl:3: USE A stands inside its own node"));
}

TEST(HostileVrml, UseOfAnUnknownNameIsRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "USE Nobody"),
              HasSubstr("robot.wrl:2: USE Nobody: no node before has this name"));
}

TEST(HostileVrml, DefWithoutANameIsRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "DEF Transform { }"), HasSubstr("{ is not allowed"));
}

TEST(HostileVrml, FaceSetWithoutCoordIsAWarning) {
  const auto model = parseVrml(robotWith("Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 ] } }"), "robot.wrl");
  EXPECT_TRUE(model.links.at(0).shapes.empty());
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("without coord"));
}

TEST(HostileVrml, FacesWithIndicesOutOfRangeAreDropped) {
  const auto model =
      parseVrml(robotWith(R"(Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] }
    coordIndex [ 0 1 2 -1 0 1 3 -1 0 1 2147483647 -1 0 1 -2147483648 -1 0 1 ] } })"),
                "robot.wrl");
  ASSERT_EQ(1u, model.links.at(0).shapes.size());
  EXPECT_EQ(1u, model.links[0].shapes[0].surface->triangles.size());
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("3 faces were dropped"));
}

TEST(HostileVrml, LongTextsAndWordsAreRefused) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "WorldInfo { title \"" + std::string(30'000'000, 'x') + "\" }"),
              HasSubstr("a text longer than 1048576 characters"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "DEF " + std::string(5'000'000, 'x') + " Group { }"),
              HasSubstr("a word longer than 4096 characters"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "WorldInfo { title \"" + std::string(100, 'x')),
              HasSubstr("has no closing quote"));
}

TEST(HostileVrml, OtherFormatsAreRefused) {
  for (const std::string first : {"\x1f\x8b\x08\x00 gzip", "#Inventor V2.1 ascii", "#Inventor V2.1 binary",
                                  "#VRML V1.0 ascii", "#X3D V3.0 utf8", "", "<robot/>", "#VRML V2.0 utf16"})
    EXPECT_THAT(vrmlRefusal(first + "\nGroup { }\n"), HasSubstr("the first line must begin with #VRML V2.0 utf8"))
        << first;
  EXPECT_THAT(vrmlRefusal(vrmlHeader + std::string("Group \0 { }", 11)), HasSubstr("control character"));
}

TEST(HostileVrml, NumbersMustBeFinite) {
  for (const std::string number :
       {"nan", "-nan", "inf", "-inf", "1e999", "-1e999", "1,5e", "0x", "--1", "1.5.2", "abc", "1e", "TRUE"})
    EXPECT_THAT(vrmlRefusal(robotWith("Transform { translation 0 0 " + number + " }")), HasSubstr("is not allowed"))
        << number;
  EXPECT_THAT(vrmlRefusal(robotWith("Shape { geometry IndexedFaceSet { coord Coordinate { point [ 1e300 0 0 ] } } }")),
              HasSubstr("out of the range of a float"));
  EXPECT_THAT(vrmlRefusal(robotWith("Switch { whichChoice 99999999999 }")), HasSubstr("whole number of 32 bits"));
}

TEST(HostileVrml, NotANumberInNormalsIsAWarning) {
  const auto model =
      parseVrml(robotWith(R"(Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] }
    normal Normal { vector [ 0 0 1, 0 0 1, -nan -nan nan ] } coordIndex [ 0 1 2 ] } })"),
                "robot.wrl");
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("a normal is not a direction"));
  const Shape& shape = model.links.at(0).shapes.at(0);
  for (const auto& normal : shape.surface->normals) EXPECT_TRUE(normal.isApprox(Eigen::Vector3f(0, 0, 1)));
}

TEST(HostileVrml, ManyPointsAreReadWithinTheBudget) {
  const std::string points = repeated("0.5 1.25 -2 ", 3'000'000);
  const std::string shape = "Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points + " ] } } }";
  EXPECT_EQ("accepted", vrmlRefusal(robotWith(shape)));
  ModelBudget budget;
  budget.values = 1'000'000;
  EXPECT_THAT(vrmlRefusal(robotWith(shape), budget), HasSubstr("more than 1000000 values"));
}

TEST(HostileVrml, HugePicturesAndGridsAreRefused) {
  EXPECT_THAT(
      vrmlRefusal(vrmlHeader + "Shape { appearance Appearance { texture PixelTexture { image 65535 65535 4 0 } } }"),
      HasSubstr("a picture of more than"));
  EXPECT_THAT(
      vrmlRefusal(robotWith("Shape { geometry ElevationGrid { xDimension 65536 zDimension 65536 height [ 0 ] } }")),
      HasSubstr("ElevationGrid has 1 heights"));
  const std::string row = repeated("0 0 ", 2000);
  EXPECT_THAT(vrmlRefusal(robotWith("Shape { geometry Extrusion { crossSection [ " + row + " ] spine [ " +
                                    repeated("0 0 0 ", 2000) + " ] } }")),
              HasSubstr("triangles in the file"));
}

TEST(HostileVrml, CombsOfManyTeethEndWithinTheEffort) {
  // A concave polygon whose ears lie far apart, many times over.
  std::string points, face;
  for (int i = 0; i < 1000; ++i) {
    points += std::to_string(i) + " " + std::to_string(i % 2 ? 0 : 1000 - i) + " 0 ";
    face += std::to_string(i) + " ";
  }
  const auto model =
      parseVrml(robotWith("Shape { geometry IndexedFaceSet { convex FALSE coord Coordinate { point [ " + points +
                          " 500 -9 0 ] } coordIndex [ " + repeated(face + "1000 -1 ", 200) + " ] } }"),
                "robot.wrl");
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("too many corners"));
}

TEST(HostileVrml, FieldsMustBeKnownAndGivenOnce) {
  EXPECT_THAT(vrmlRefusal(robotWith("Transform {\n colour 1 0 0 }")), HasSubstr("Transform has no field colour"));
  EXPECT_THAT(vrmlRefusal(robotWith("Shape { geometry Box { size 1 1 1 size 2 2 2 } }")),
              HasSubstr("the field size twice"));
  EXPECT_THAT(vrmlRefusal(robotWith("Transform { translation IS x }")),
              HasSubstr("IS is allowed only in the body of a PROTO"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "PROTO A [ field SFFloat x 1 ] { Transform { translation IS x } }"),
              HasSubstr("the type of x differs"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "PROTO A [ ] { Transform { translation IS x } }"), HasSubstr("has no field x"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "PROTO Box [ ] { }"), HasSubstr("this is the name of a VRML97 node"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "PROTO A [ " +
                          [] {
                            std::string fields;
                            for (int i = 0; i < 300; ++i) fields += "field SFBool b" + std::to_string(i) + " TRUE ";
                            return fields;
                          }() +
                          "] { }"),
              HasSubstr("a PROTO of more than 256 fields"));
}

TEST(HostileVrml, BracesMustBalance) {
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Odd { [ } ]"), HasSubstr("] is expected here"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Odd { "), HasSubstr("the file ends inside a node"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Group { ] "), HasSubstr("] is not allowed"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "Group { } }"), HasSubstr("} is not allowed"));
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "PROTO A [ ] { Group { }"), HasSubstr("the file ends inside a PROTO"));
}

TEST(HostileVrml, WarningsAreListedUpToALimit) {
  const auto model = parseVrml(robotWith(repeated("Odd { } ", 5000)), "robot.wrl");
  EXPECT_EQ(201u, model.warnings.size());
  EXPECT_THAT(model.warnings.back().text, HasSubstr("more warnings"));
}

TEST(HostileVrml, EveryLimitNamesItself) {
  ModelBudget small;
  small.bytes = 100;
  EXPECT_THAT(vrmlRefusal(robotWith(repeated(" ", 100)), small), HasSubstr("more than 100 bytes"));
  small = {};
  small.nodes = 5;
  EXPECT_THAT(vrmlRefusal(robotWith(repeated("Group { } ", 10)), small), HasSubstr("more than 5 nodes"));
  small = {};
  small.identifier = 20;
  EXPECT_THAT(vrmlRefusal(vrmlHeader + "DEF " + std::string(21, 'a') + " Group { }", small),
              HasSubstr("longer than 20"));
}

// The dog's file without its meshes: small enough to try very many variants of it.
std::string dogWithoutMeshes() {
  std::string text = readFile(SOURCE_DIR "/resources/robots/ers7.wrl");
  std::string kept;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.find("IndexedFaceSet") == std::string::npos) kept += line + "\n";
    begin = end + 1;
  }
  return kept;
}

TEST(HostileVrml, ATruncatedDogIsRefusedWhereverItIsCut) {
  const std::string text = dogWithoutMeshes();
  ASSERT_EQ("accepted", vrmlRefusal(text));
  const std::size_t last = text.find_last_of('}');
  for (int cut = 1; cut <= 200; ++cut)
    EXPECT_NE("accepted", vrmlRefusal(text.substr(0, last * static_cast<std::size_t>(cut) / 200))) << cut;
}

TEST(HostileVrml, ADamagedDogIsReadOrRefusedButNeverMore) {
  const std::string whole = readFile(SOURCE_DIR "/resources/robots/ers7.wrl"), small = dogWithoutMeshes();
  Random random(2004);
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::string text = trial % 8 == 0 ? whole : small;
    for (int change = 0; change < 3; ++change) {
      const std::size_t at = random.below(text.size());
      switch (random.below(4)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.erase(at, 1 + random.below(20));
          break;
        case 2:
          text.insert(at, std::string(1, "{}[]\"#-.e9 "[random.below(11)]));
          break;
        default:
          text.insert(at, text.substr(random.below(text.size()), random.below(60)));
      }
    }
    refused += vrmlRefusal(text) != "accepted";
  }
  EXPECT_GT(refused, 200);
  EXPECT_LT(refused, 400);
}

}  // namespace
}  // namespace btr::test
