#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/load_model.h"

namespace btr::vrml {

enum class FieldType {
  SFBool,
  SFColor,
  SFFloat,
  SFImage,
  SFInt32,
  SFNode,
  SFRotation,
  SFString,
  SFTime,
  SFVec2f,
  SFVec3f,
  MFColor,
  MFFloat,
  MFInt32,
  MFNode,
  MFRotation,
  MFString,
  MFTime,
  MFVec2f,
  MFVec3f
};

struct Node;

/// The value of a field. Which vector is filled depends on the type.
struct Value {
  FieldType type = FieldType::SFFloat;
  int line = 0;
  std::vector<double> numbers;  ///< SFFloat, SFVec2f, SFVec3f, SFColor, SFRotation, SFTime, MFFloat, MFRotation, MFTime
  std::vector<float> packed;    ///< MFVec2f, MFVec3f, MFColor: the bulk of a mesh
  std::vector<std::int32_t> integers;  ///< SFBool, SFInt32, MFInt32
  std::vector<std::string> texts;      ///< SFString, MFString
  std::vector<const Node*> nodes;      ///< SFNode, MFNode; nullptr for NULL and for skipped nodes
};
using ValuePtr = std::shared_ptr<const Value>;

struct FieldDescription {
  std::string name;
  FieldType type = FieldType::SFFloat;
  ValuePtr byDefault;  ///< of a PROTO's field; the built-in nodes' defaults stand where they are read
};

/// A kind of node: built in, or declared by a PROTO.
struct NodeType {
  std::string name;
  std::vector<FieldDescription> fields;
  const FieldDescription* find(std::string_view field) const;
};

struct Field {
  std::string_view name;  ///< belongs to the NodeType
  ValuePtr value;
  std::string is;  ///< inside a PROTO's body: the name of the interface field that will give the value
};

/// A node of the tree, with the fields that the file gave. Belongs to its Document. A node that is used several times
/// (USE) is one node; there are no cycles, because a name can be used only after its node is complete.
struct Node {
  const NodeType* type = nullptr;
  std::string def;
  int line = 0;
  int file = 0;            ///< index into Document::places
  std::size_t height = 1;  ///< longest way down, this node included
  std::vector<Field> fields;

  const std::string& kind() const { return type->name; }
  /// The value given in the file or by the PROTO's default, or nullptr.
  const Value* find(std::string_view field) const;
  /// The value given in the file, or nullptr.
  const Value* given(std::string_view field) const;
};

/// What was read from a file and the files it inlines. Owns all nodes flat, so that no destructor recurses.
struct Document {
  std::deque<Node> nodes;
  std::deque<NodeType> types;  ///< of PROTOs
  std::vector<const Node*> roots;
  std::vector<std::string> places;  ///< file names for messages; [0] is the main file
  std::vector<Warning> warnings;

  /// Remembers a warning; of very many only the first 200 are kept.
  void warn(int file, int line, const std::string& text, Warning::Loss loss = Warning::Loss::none);
  [[noreturn]] void fail(const Node& node, const std::string& message) const;
};

/// The built-in node of that name (VRML97 and the OpenHRP vocabulary), or nullptr.
const NodeType* builtIn(std::string_view name);
/// Whether the name belongs to the robot vocabulary: such a PROTO's instances are read by their fields, not expanded.
bool isRobotWord(std::string_view name);
/// The type of that name; false if there is none.
bool fieldType(std::string_view name, FieldType& type);
/// How many numbers make one element (SFVec3f: 3).
int arity(FieldType type);
bool isMany(FieldType type);

}  // namespace btr::vrml
