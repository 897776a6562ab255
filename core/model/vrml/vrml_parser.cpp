#include "core/model/vrml/vrml_parser.h"

#include <algorithm>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/utf8.h"

namespace btr::vrml {
namespace {

/// Sets a variable for the length of a scope.
template <class T>
class Within {
 public:
  Within(T& variable, T value) : variable_(variable), before_(std::move(variable)) { variable_ = std::move(value); }
  ~Within() { variable_ = std::move(before_); }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  T& variable_;
  T before_;
};

constexpr std::string_view header = "#VRML V2.0 utf8";

}  // namespace

Parser::Parser(Document& document, const ModelBudget& budget, Spent& spent, const InlineFolder* files)
    : document_(document), budget_(budget), spent_(spent), files_(files) {}

std::vector<const Node*> Parser::readFile(std::string_view text, const std::string& place, const std::string& path) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const bool inlined = !openFiles_.empty();
  if (text.substr(0, header.size()) != header && (!inlined || text.substr(0, 1) == "#")) {
    const std::string first(text.substr(0, std::min(text.find_first_of("\r\n"), text.size())));
    // Parts of old models have no header; another format's header is refused everywhere.
    if (!inlined || first.find("VRML") != std::string::npos || first.find("Inventor") != std::string::npos)
      throw InputError(place + ":1: \"" + shorten(first) + "\" is not allowed; the first line must begin with " +
                       std::string(header));
  }
  spent_.bytes += text.size();
  if (spent_.bytes > budget_.bytes)
    throw InputError(place + ": more than " + std::to_string(budget_.bytes) + " bytes are not allowed");

  Scanner scanner(text, place, budget_);
  Scope scope;
  const Within<Scanner*> withScanner(scanner_, &scanner);
  const Within<Scope*> withScope(scope_, &scope);
  const Within<int> withFile(file_, static_cast<int>(document_.places.size()));
  document_.places.push_back(place);
  openFiles_.push_back(path);
  auto roots = readStatements();
  openFiles_.pop_back();
  return roots;
}

std::vector<const Node*> Parser::readStatements() {
  std::vector<const Node*> nodes;
  while (scanner_->peek().kind != TokenKind::end) {
    if (readDeclaration()) continue;
    if (const Node* node = readNodeStatement()) nodes.push_back(node);
  }
  return nodes;
}

bool Parser::readDeclaration() {
  const Token& next = scanner_->peek();
  if (next.kind != TokenKind::word) return false;
  if (next.raw == "PROTO") return readProto(), true;
  if (next.raw == "EXTERNPROTO") return readExternProto(), true;
  if (next.raw != "ROUTE") return false;
  // Events do not flow here; a route needs only be well formed.
  scanner_->take();
  scanner_->takeName("NODE.event");
  const Token to = scanner_->take(TokenKind::word, "TO");
  if (to.raw != "TO") fail(to.line, describe(to) + " is not allowed; TO is expected here");
  scanner_->takeName("NODE.event");
  return true;
}

const Node* Parser::readNodeStatement() {
  const int line = scanner_->peek().line;
  const std::string word = scanner_->takeName("a node");
  if (word == "NULL") return nullptr;
  if (word == "USE") {
    const std::string name = scanner_->takeName("the name of a node");
    if (scope_->open.count(name)) fail(line, "USE " + shorten(name) + " stands inside its own node");
    const auto found = scope_->defs.find(name);
    if (found == scope_->defs.end()) fail(line, "USE " + shorten(name) + ": no node before has this name");
    return found->second;
  }
  if (word != "DEF") return readNode(word, "", line);

  // A name counts only when its node is complete, so that no node can contain itself.
  const std::string def = scanner_->takeName("a name after DEF");
  const std::string type = scanner_->takeName("a node after DEF and its name");
  const bool first = scope_->open.insert(def).second;
  const Node* node = readNode(type, def, line);
  if (first) scope_->open.erase(def);
  scope_->defs[def] = node;
  return node;
}

const Node* Parser::readNode(const std::string& type, const std::string& def, int line) {
  const Within<std::size_t> deeper(depth_, depth_ + 1);
  if (depth_ > budget_.depth) fail(line, "nodes deeper than " + std::to_string(budget_.depth) + " are not allowed");
  const ProtoPtr proto = findProto(type);
  const bool known = proto && !proto->isExtern;
  const NodeType* nodeType = known ? proto->type : builtIn(type);
  scanner_->take(TokenKind::openBrace, ("{ after " + shorten(type)).c_str());
  if (!nodeType) {
    if (type != "Script")
      warn(line, "the node " + shorten(type) + " is not known and was skipped", Warning::Loss::collision);
    skipBraces();
    return nullptr;
  }

  Node& node = newNode(nodeType, line);
  node.def = def;
  while (!scanner_->takeIf(TokenKind::closeBrace))
    if (!readDeclaration()) readField(node);
  return complete(node, known ? proto.get() : nullptr);
}

/// Measures the node and puts in its place what it stands for: a PROTO's body, an inlined file.
const Node* Parser::complete(Node& node, const Proto* proto) {
  measure(node);
  if (proto && !isRobotWord(proto->type->name)) return expand(*proto, node);
  if (node.kind() == "Inline" && !scope_->building) return expandInline(node);
  return &node;
}

void Parser::readField(Node& node) {
  const Token token = scanner_->peek();
  const std::string name = scanner_->takeName("a field or }");
  const FieldDescription* field = node.type->find(name);
  if (!field) {
    if (readEvent()) return;
    fail(token.line, node.kind() + " has no field " + shorten(name));
  }
  for (const Field& other : node.fields)
    if (other.name == name) fail(token.line, node.kind() + " has the field " + name + " twice");

  Field result{field->name, nullptr, ""};
  if (!readIs(result, field->type)) {
    charge(1, token.line);
    // Old models write the axis of a joint as "X", "Y" or "Z".
    const bool axisWord = name == "jointAxis" && scanner_->peek().kind == TokenKind::text;
    result.value = readValue(axisWord ? FieldType::SFString : field->type, *node.type, name);
  }
  node.fields.push_back(std::move(result));
}

/// "IS name" in a PROTO's body: the value comes from the interface.
bool Parser::readIs(Field& field, FieldType type) {
  const Token& next = scanner_->peek();
  if (next.kind != TokenKind::word || next.raw != "IS") return false;
  const int line = scanner_->take().line;
  if (!scope_->building) fail(line, "IS is allowed only in the body of a PROTO");
  const std::string name = scanner_->takeName("a field of the PROTO");
  if (scope_->building->events.count(name)) return true;
  const FieldDescription* source = scope_->building->type->find(name);
  if (!source) fail(line, "the PROTO " + scope_->building->type->name + " has no field " + shorten(name));
  if (source->type != type) fail(line, "the type of " + name + " differs from that of " + std::string(field.name));
  field.is = name;
  return true;
}

/// "set_x IS event" in a PROTO's body: events do not flow here.
bool Parser::readEvent() {
  if (!scope_->building || scanner_->peek().kind != TokenKind::word || scanner_->peek().raw != "IS") return false;
  const int line = scanner_->take().line;
  const std::string name = scanner_->takeName("an event of the PROTO");
  if (scope_->building->events.count(name) || scope_->building->type->find(name)) return true;
  fail(line, "the PROTO " + scope_->building->type->name + " has no event " + shorten(name));
}

/// Skips what stands between braces, the closing one included. Braces and brackets must balance.
void Parser::skipBraces() {
  std::vector<TokenKind> closing{TokenKind::closeBrace};
  while (!closing.empty()) {
    const Token token = scanner_->take();
    if (token.kind == TokenKind::openBrace) closing.push_back(TokenKind::closeBrace);
    if (token.kind == TokenKind::openBracket) closing.push_back(TokenKind::closeBracket);
    if (closing.size() > budget_.depth)
      fail(token.line, "nodes deeper than " + std::to_string(budget_.depth) + " are not allowed");
    if (token.kind == TokenKind::closeBrace || token.kind == TokenKind::closeBracket) {
      if (token.kind != closing.back())
        fail(token.line, describe(token) + " is not allowed; " + (token.raw == "}" ? "]" : "}") + " is expected here");
      closing.pop_back();
    }
    if (token.kind == TokenKind::end) fail(token.line, "the file ends inside a node");
  }
}

Node& Parser::newNode(const NodeType* type, int line) {
  if (++spent_.nodes > budget_.nodes)
    fail(line, "more than " + std::to_string(budget_.nodes) + " nodes are not allowed (PROTO instances count in full)");
  Node& node = document_.nodes.emplace_back();
  node.type = type;
  node.line = line;
  node.file = file_;
  return node;
}

/// The height keeps every later walk down the tree short, also when USE stacks nodes that were written side by side.
void Parser::measure(Node& node) const {
  for (const Field& field : node.fields)
    if (field.value)
      for (const Node* child : field.value->nodes)
        if (child) node.height = std::max(node.height, child->height + 1);
  if (node.height > budget_.depth)
    fail(node.line, "nodes deeper than " + std::to_string(budget_.depth) + " are not allowed");
}

const Node* Parser::expandInline(const Node& node) {
  const auto refuse = [&](const std::string& url, const std::string& why) -> const Node* {
    warn(node.line, "Inline \"" + shorten(url) + "\" was not followed: " + why, Warning::Loss::collision);
    return nullptr;
  };
  const Value* urls = node.given("url");
  if (!urls || urls->texts.empty()) return nullptr;
  const std::string& url = urls->texts.front();
  if (!files_ || openFiles_.back().empty()) return refuse(url, "there is no folder to look in");
  const InlineFolder::Answer answer = files_->find(url, openFiles_.back());
  if (answer.path.empty()) return refuse(url, answer.refusal);

  // What is inlined counts in full.
  if (std::count(openFiles_.begin(), openFiles_.end(), answer.path))
    fail(node.line, "Inline \"" + shorten(url) + "\": a file may not contain itself");
  if (openFiles_.size() > budget_.inlineDepth)
    fail(node.line, "Inline deeper than " + std::to_string(budget_.inlineDepth) + " is not allowed");
  if (++spent_.inlineFiles > budget_.inlineFiles)
    fail(node.line, "more than " + std::to_string(budget_.inlineFiles) + " inlined files are not allowed");
  const std::string text = btr::readFile(answer.path, budget_.bytes);
  auto roots = readFile(isUtf8(text) ? text : utf8OfLatin1(text), url, answer.path);

  Node& group = newNode(builtIn("Group"), node.line);
  group.def = node.def;
  auto children = std::make_shared<Value>();
  children->type = FieldType::MFNode;
  children->line = node.line;
  children->nodes = std::move(roots);
  group.fields.push_back({builtIn("Group")->find("children")->name, std::move(children), ""});
  measure(group);
  return &group;
}

}  // namespace btr::vrml
