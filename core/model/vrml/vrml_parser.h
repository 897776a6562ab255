#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/model/vrml/inline_folder.h"
#include "core/model/vrml/vrml_scanner.h"
#include "core/model/vrml/vrml_tree.h"

namespace btr::vrml {

/// What has been spent of the budget, over all files together.
struct Spent {
  std::size_t nodes = 0;
  std::size_t values = 0;
  std::size_t bytes = 0;
  std::size_t inlineFiles = 0;
};

/// A PROTO: its interface as a node type, and its body as a template whose fields may wait for an interface field (IS).
struct Proto {
  const NodeType* type = nullptr;
  std::unordered_set<std::string> events;  ///< eventIn and eventOut: may be named by IS, mean nothing here
  const Node* body = nullptr;              ///< first node of the body, or none
  bool isExtern = false;                   ///< EXTERNPROTO: never fetched
};
using ProtoPtr = std::shared_ptr<const Proto>;

/// Names that are visible in a file or a PROTO's body. A body sees the PROTOs around it, but not its DEF names.
struct Scope {
  std::unordered_map<std::string, const Node*> defs;  ///< only complete nodes; nullptr: its node was skipped
  std::unordered_set<std::string> open;               ///< DEF names whose node is not complete yet
  std::unordered_map<std::string, ProtoPtr> protos;
  const Scope* outer = nullptr;
  const Proto* building = nullptr;  ///< the PROTO whose body is read
};

/// Reads VRML97 text into a Document within a budget. Table-driven: what a node may hold stands in vrml_nodes.cpp.
class Parser {
 public:
  /// `files` gives inlined files; none means that Inline is refused.
  Parser(Document& document, const ModelBudget& budget, Spent& spent, const InlineFolder* files);

  /// Reads one file. `path` is empty for a text from memory. Only the main file must have the "#VRML V2.0 utf8" line.
  std::vector<const Node*> readFile(std::string_view text, const std::string& place, const std::string& path);

 private:
  // vrml_parser.cpp
  std::vector<const Node*> readStatements();
  bool readDeclaration();  ///< PROTO, EXTERNPROTO or ROUTE, if one stands here
  const Node* readNodeStatement();
  const Node* readNode(const std::string& type, const std::string& def, int line);
  const Node* complete(Node& node, const Proto* proto);
  void readField(Node& node);
  bool readIs(Field& field, FieldType type);
  bool readEvent();
  void skipBraces();
  Node& newNode(const NodeType* type, int line);
  void measure(Node& node) const;
  const Node* expandInline(const Node& node);

  // vrml_values.cpp
  ValuePtr readValue(FieldType type, const NodeType& of, std::string_view field);
  void readElement(Value& value, FieldType type, bool notANumberAllowed);
  void readNodeValue(Value& value);
  void readImage();
  double readNumber(bool notANumberAllowed);
  std::int32_t readInteger();
  void charge(std::size_t values, int line);

  // vrml_proto.cpp
  void readProto();
  void readExternProto();
  void readInterface(Proto& proto, NodeType& type, bool withDefaults);
  ProtoPtr findProto(const std::string& name) const;
  const Node* expand(const Proto& proto, const Node& instance);
  const Node* copy(const Node& original, const Node& instance, std::unordered_map<const Node*, const Node*>& done);
  void copyField(Field& field, const Node& instance, std::unordered_map<const Node*, const Node*>& done);

  [[noreturn]] void fail(int line, const std::string& message) const { scanner_->fail(line, message); }
  void warn(int line, const std::string& text, Warning::Loss loss = Warning::Loss::none) {
    document_.warn(file_, line, text, loss);
  }

  Document& document_;
  const ModelBudget& budget_;
  Spent& spent_;
  const InlineFolder* files_;
  Scanner* scanner_ = nullptr;
  Scope* scope_ = nullptr;
  int file_ = 0;
  std::size_t depth_ = 0;               ///< of nodes and PROTO bodies being read, over all files
  std::vector<std::string> openFiles_;  ///< canonical paths, outermost first
};

}  // namespace btr::vrml
