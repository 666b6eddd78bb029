#include "source_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace hersey::model {
namespace {

/// More than any model needs; keeps a few lines of nested aliases from filling the memory.
constexpr std::size_t most_nodes = 1'000'000;

/// Thrown to leave the parser once a limit is passed.
struct TooLarge {};

std::size_t size_of(const Node& node) {
  std::size_t size = 1;
  for (const Node& item : node.items) size += size_of(item);
  for (const Entry& entry : node.entries) size += size_of(entry.value);
  return size;
}

/// Builds the tree from the parser's events, which, unlike yaml-cpp's own nodes, keep duplicate keys and their places.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(std::string file, const std::string& text, std::vector<Fault>& faults)
      : file_(std::move(file)), source_(text), faults_(faults) {}

  Node take_root() { return std::move(root_); }
  [[nodiscard]] int documents() const { return documents_; }

  void OnDocumentStart(const YAML::Mark&) override { ++documents_; }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node;
    node.position = position(mark);
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto target = anchors_.find(anchor);
    if (target == anchors_.end()) {  // an alias inside its own anchor
      report(position(mark), "an alias of the value it stands in", "an alias of an earlier value");
      add(Node{.position = position(mark), .reported = true}, 0);
      return;
    }
    Node copy = target->second;
    count_ += size_of(copy);
    add(std::move(copy), 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node{.kind = Node::Kind::scalar, .position = position(mark), .text = value};
    const bool is_quoted = tag == "!";
    const auto at = static_cast<std::size_t>(std::max(0, mark.pos)) + (is_quoted ? 1 : 0);
    const bool maps = at <= source_.size() && source_.compare(at, value.size(), value) == 0;
    node.text_offset = maps ? (is_quoted ? 1 : 0) : -1;
    add(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Node{.kind = Node::Kind::sequence, .position = position(mark)}, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Node{.kind = Node::Kind::mapping, .position = position(mark)}, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A sequence or mapping under construction, and the key waiting for its value.
  struct Open {
    Node node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    std::string key;
    SourcePosition key_position;
  };

  [[nodiscard]] SourcePosition position(const YAML::Mark& mark) const {
    return {file_, mark.line + 1, mark.column + 1};
  }

  void report(const SourcePosition& at, std::string found, std::string expected) {
    faults_.push_back({at, "", std::move(found), std::move(expected), ""});
  }

  void open(Node node, YAML::anchor_t anchor) {
    if (++count_ > most_nodes) throw TooLarge{};
    Open opened;
    opened.node = std::move(node);
    opened.anchor = anchor;
    open_.push_back(std::move(opened));
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    add(std::move(closed.node), closed.anchor);
  }

  void add(Node node, YAML::anchor_t anchor) {
    if (++count_ > most_nodes) throw TooLarge{};
    if (anchor != 0) anchors_[anchor] = node;
    if (open_.empty()) {
      if (documents_ <= 1) root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == Node::Kind::sequence) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      take_key(parent, node);
    } else {
      parent.has_key = false;
      add_entry(parent, std::move(node));
    }
  }

  void take_key(Open& parent, const Node& node) {
    parent.has_key = true;
    parent.key_position = node.position;
    parent.key = node.text;
    if (node.kind != Node::Kind::scalar) {
      report(node.position, description_of(node) + " as a key", "a name");
      parent.key.clear();
    }
  }

  void add_entry(Open& parent, Node value) {
    for (const Entry& entry : parent.node.entries) {
      if (entry.key != parent.key) continue;
      report(parent.key_position,
             "duplicate key '" + parent.key + "' (first at line " + std::to_string(entry.position.line) + ")",
             "each key once");
      return;
    }
    if (value.kind == Node::Kind::null) value.position = parent.key_position;  // the parser names the next line
    parent.node.entries.push_back({std::move(parent.key), parent.key_position, std::move(value)});
  }

  std::string file_;
  const std::string& source_;
  std::vector<Fault>& faults_;
  Node root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Node> anchors_;
  std::size_t count_ = 0;
  int documents_ = 0;
};

std::string line_of(const std::string& text, int line) {
  std::istringstream stream(text);
  std::string content;
  for (int i = 0; i <= line; ++i) {
    if (!std::getline(stream, content)) return {};
  }
  return content;
}

/// The parser's messages in the user's words, with the usual cause where the line shows it.
Fault syntax_fault(const YAML::Exception& error, const std::string& text, const std::string& file) {
  static const std::map<std::string, std::string> meanings = {
      {YAML::ErrorMsg::END_OF_SEQ_FLOW, "a '[' without its ']'"},
      {YAML::ErrorMsg::END_OF_MAP_FLOW, "a '{' without its '}'"},
      {YAML::ErrorMsg::EOF_IN_SCALAR, "a quote that is not closed"},
      {YAML::ErrorMsg::MAP_VALUE, "a ':' that does not fit here"},
  };
  const auto meaning = meanings.find(error.msg);
  const std::string line = line_of(text, error.mark.line);
  const bool has_tab = line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos;
  std::string hint;
  if (has_tab) {
    hint = "indent with spaces, not tabs";
  } else if (line.find("${") != std::string::npos && line.find("\"${") == std::string::npos) {
    hint = "inside braces and brackets write \"${name}\" in quotes";
  } else if (error.msg == YAML::ErrorMsg::MAP_VALUE) {
    hint = "check the indentation, and quote text that contains ': '";
  }
  return {{file, error.mark.line + 1, error.mark.column + 1},
          "",
          meaning != meanings.end() ? meaning->second : error.msg,
          "valid YAML",
          hint};
}

}  // namespace

const Node* Node::find(const std::string& key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

Node* Node::find(const std::string& key) {
  for (Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

const std::string& written(const Node& node) {
  return node.formula.empty() || node.is_pasted ? node.text : node.formula;
}

std::string description_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::scalar:
      return "'" + written(node) + "'" + (node.origin.empty() ? "" : " (from " + node.origin + ")");
    case Node::Kind::sequence:
      return "a list";
    case Node::Kind::mapping:
      break;
  }
  return "a mapping";
}

std::optional<Node> parse_yaml(const std::string& text, const std::string& file, std::vector<Fault>& faults) {
  TreeBuilder builder(file, text, faults);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
      if (builder.documents() > 1) {
        faults.push_back({{file, 0, 0}, "", "a second YAML document", "one document", "remove the line '---'"});
        return std::nullopt;
      }
    }
    return builder.take_root();
  } catch (const YAML::Exception& error) {
    faults.push_back(syntax_fault(error, text, file));
  } catch (const TooLarge&) {
    faults.push_back({{file, 0, 0}, "", "more than a million values", "a model file", ""});
  }
  return std::nullopt;
}

void move_to(Node& node, const SourcePosition& position) {
  node.position = position;
  node.text_offset = -1;
  for (Node& item : node.items) move_to(item, position);
  for (Entry& entry : node.entries) {
    entry.position = position;
    move_to(entry.value, position);
  }
}

}  // namespace hersey::model
