// PROTO: its interface becomes a node type, its body a template. Each instance is a deep copy that is charged to the
// node budget. A PROTO becomes known only after its body was read, so it cannot contain itself.
#include "core/model/vrml/vrml_parser.h"

namespace btr::vrml {
namespace {

constexpr std::size_t mostFields = 256;  // of one PROTO; keeps the look-up of a field short

}  // namespace

ProtoPtr Parser::findProto(const std::string& name) const {
  for (const Scope* scope = scope_; scope; scope = scope->outer) {
    const auto found = scope->protos.find(name);
    if (found != scope->protos.end()) return found->second;
  }
  return nullptr;
}

/// [ field TYPE name default, exposedField …, eventIn TYPE name, eventOut … ]
void Parser::readInterface(Proto& proto, NodeType& type, bool withDefaults) {
  scanner_->take(TokenKind::openBracket, "[ after the name of a PROTO");
  while (!scanner_->takeIf(TokenKind::closeBracket)) {
    const Token kind = scanner_->take(TokenKind::word, "field, exposedField, eventIn, eventOut or ]");
    const bool event = kind.raw == "eventIn" || kind.raw == "eventOut";
    if (!event && kind.raw != "field" && kind.raw != "exposedField")
      fail(kind.line, describe(kind) + " is not allowed; field, exposedField, eventIn, eventOut or ] is expected here");
    const Token typeName = scanner_->take(TokenKind::word, "the type of a field");
    FieldType valueType{};
    if (!fieldType(typeName.raw, valueType))
      fail(typeName.line, describe(typeName) + " is not allowed; the type of a field is expected here");
    const std::string name = scanner_->takeName("the name of a field");
    charge(1, kind.line);

    if (event) {
      proto.events.insert(name);
      continue;
    }
    if (type.find(name)) fail(kind.line, "the PROTO " + type.name + " has the field " + shorten(name) + " twice");
    if (type.fields.size() >= mostFields)
      fail(kind.line, "a PROTO of more than " + std::to_string(mostFields) + " fields is not allowed");
    ValuePtr byDefault;
    if (withDefaults) {
      const bool axisWord = name == "jointAxis" && scanner_->peek().kind == TokenKind::text;
      byDefault = readValue(axisWord ? FieldType::SFString : valueType, type, name);
    }
    type.fields.push_back({name, valueType, std::move(byDefault)});
  }
}

void Parser::readProto() {
  const int line = scanner_->take().line;
  const std::string name = scanner_->takeName("the name of a PROTO");
  if (builtIn(name) && !isRobotWord(name)) fail(line, "PROTO " + name + ": this is the name of a VRML97 node");
  if (++depth_ > budget_.depth) fail(line, "nodes deeper than " + std::to_string(budget_.depth) + " are not allowed");
  if (++spent_.nodes > budget_.nodes)
    fail(line, "more than " + std::to_string(budget_.nodes) + " nodes are not allowed");

  auto proto = std::make_shared<Proto>();
  NodeType& type = document_.types.emplace_back();
  type.name = name;
  proto->type = &type;
  readInterface(*proto, type, true);

  // The body is read in a scope of its own.
  scanner_->take(TokenKind::openBrace, "{ before the body of a PROTO");
  Scope scope;
  scope.outer = scope_;
  scope.building = proto.get();
  Scope* const before = scope_;
  scope_ = &scope;
  while (!scanner_->takeIf(TokenKind::closeBrace)) {
    if (scanner_->peek().kind == TokenKind::end) fail(scanner_->peek().line, "the file ends inside a PROTO");
    if (readDeclaration()) continue;
    const Node* node = readNodeStatement();
    // Only the first node stands for the PROTO, the others hold scripts and the like.
    if (!proto->body) proto->body = node;
  }
  scope_ = before;
  --depth_;
  scope_->protos[name] = std::move(proto);
}

/// Another file's PROTO is never fetched: a built-in node of its name is used, or else its instances are skipped.
void Parser::readExternProto() {
  const int line = scanner_->take().line;
  const std::string name = scanner_->takeName("the name of a PROTO");
  auto proto = std::make_shared<Proto>();
  proto->isExtern = true;
  NodeType type;
  type.name = name;
  readInterface(*proto, type, false);
  readValue(FieldType::MFString, type, "url");
  warn(line, "EXTERNPROTO " + shorten(name) + " was not followed: only Inline may name another file");
  scope_->protos[name] = std::move(proto);
}

const Node* Parser::expand(const Proto& proto, const Node& instance) {
  if (!proto.body) return nullptr;
  std::unordered_map<const Node*, const Node*> done;
  const Node* result = copy(*proto.body, instance, done);
  // The copy of the first node is new and ours; it takes the name of the instance.
  if (result && !instance.def.empty()) const_cast<Node*>(result)->def = instance.def;
  return result;
}

const Node* Parser::copy(const Node& original, const Node& instance,
                         std::unordered_map<const Node*, const Node*>& done) {
  const auto found = done.find(&original);
  if (found != done.end()) return found->second;
  Node& node = newNode(original.type, original.line);
  node.def = original.def;
  node.file = original.file;
  node.fields = original.fields;
  for (Field& field : node.fields) copyField(field, instance, done);
  measure(node);
  const Node* result = node.kind() == "Inline" && !scope_->building ? expandInline(node) : &node;
  done[&original] = result;
  return result;
}

void Parser::copyField(Field& field, const Node& instance, std::unordered_map<const Node*, const Node*>& done) {
  if (!field.is.empty()) {
    // The instance's own value, the interface's default, or the field of an outer PROTO that the instance itself waits
    // for.
    for (const Field& given : instance.fields) {
      if (given.name != field.is) continue;
      field.value = given.value;
      field.is = given.is;
      return;
    }
    const FieldDescription* description = instance.type->find(field.is);
    field.value = description ? description->byDefault : nullptr;
    field.is.clear();
    return;
  }
  if (!field.value || field.value->nodes.empty()) return;
  auto value = std::make_shared<Value>(*field.value);
  value->nodes.clear();
  for (const Node* child : field.value->nodes) value->nodes.push_back(child ? copy(*child, instance, done) : nullptr);
  field.value = std::move(value);
}

}  // namespace btr::vrml
