#include "tree/source_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace hersey::model {
namespace {

// More than any model needs. What aliases repeat is limited apart: a few lines of them, each naming the one before
// several times, would fill any memory.
constexpr std::size_t most_nodes = 1'000'000;
constexpr std::size_t most_keys = 100'000;            // of one mapping
constexpr std::size_t most_repeated_nodes = 100'000;  // by aliases
constexpr std::size_t most_repeated_bytes = 16'000'000;
constexpr std::size_t deepest = 64;

/// Thrown to leave the parser once a limit is passed.
struct TooLarge {
  SourcePosition position;
  std::string found, expected;
};

/// Builds the tree from the parser's events, which, unlike yaml-cpp's own nodes, keep duplicate keys and their
/// locations.
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
      report(position(mark), "an alias of the value that contains it", "an alias of an earlier value");
      add(Node{.position = position(mark), .reported = true}, 0);
      return;
    }
    count_repeated(target->second, position(mark));
    add(target->second, 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node{.kind = Node::Kind::scalar, .position = position(mark), .text = value};
    const bool is_quoted = tag == "!";
    const std::size_t mark_of_utf8 = source_.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // the parser does not count it
    const auto at = static_cast<std::size_t>(std::max(0, mark.pos)) + mark_of_utf8 + (is_quoted ? 1 : 0);
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
    std::unordered_map<std::string, int> lines;  // of the keys so far
  };

  [[nodiscard]] SourcePosition position(const YAML::Mark& mark) const {
    return {file_, mark.line + 1, mark.column + 1};
  }

  void report(const SourcePosition& at, std::string found, std::string expected) {
    faults_.push_back({at, "", std::move(found), std::move(expected), ""});
  }

  /// Counts the copies that anchors keep and aliases repeat.
  void count_repeated(const Node& node, const SourcePosition& at) {
    const Extent extent = extent_of(node);
    repeated_nodes_ += extent.nodes;
    repeated_bytes_ += extent.text_bytes;
    if (repeated_nodes_ > most_repeated_nodes)
      throw TooLarge{at, "aliases that repeat more than 100000 values", "at most 100000 values repeated by aliases"};
    if (repeated_bytes_ > most_repeated_bytes)
      throw TooLarge{at, "aliases that repeat more than 16 MB of text", "at most 16 MB repeated by aliases"};
    if (open_.size() + extent.depth > deepest) throw too_deep(at);
  }

  static TooLarge too_deep(const SourcePosition& at) {
    return {at, "values within values more than 64 deep", "at most 64 levels"};
  }

  void count(const SourcePosition& at) {
    if (++count_ > most_nodes)
      throw TooLarge{at, "more than a million values", "at most a million; long tables belong into files"};
  }

  void open(Node node, YAML::anchor_t anchor) {
    count(node.position);
    if (open_.size() >= deepest) throw too_deep(node.position);
    Open opened;
    opened.node = std::move(node);
    opened.anchor = anchor;
    open_.push_back(std::move(opened));
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    merge_others_into(closed.node);
    add(std::move(closed.node), closed.anchor);
  }

  void add(Node node, YAML::anchor_t anchor) {
    count(node.position);
    if (anchor != 0) {
      count_repeated(node, node.position);
      anchors_[anchor] = node;
    }
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
    const auto [first, is_new] = parent.lines.try_emplace(parent.key, parent.key_position.line);
    if (!is_new) {
      report(parent.key_position,
             "duplicate key '" + parent.key + "' (first at line " + std::to_string(first->second) + ")",
             "each key once");
      return;
    }
    if (parent.lines.size() > most_keys)
      throw TooLarge{parent.key_position, "a mapping of more than 100000 keys", "at most 100000 keys"};
    if (value.kind == Node::Kind::null) value.position = parent.key_position;  // the parser names the next line
    parent.node.entries.push_back({std::move(parent.key), parent.key_position, std::move(value)});
  }

  /// YAML's merge key: `<<: *anchor`, or a list of them, adds what the mapping itself does not have; of several the
  /// first that has it.
  void merge_others_into(Node& mapping) {
    const auto is_merge = [](const Entry& entry) { return entry.key == "<<"; };
    const auto at = std::find_if(mapping.entries.begin(), mapping.entries.end(), is_merge);
    if (at == mapping.entries.end()) return;
    Node merged = std::move(at->value);
    mapping.entries.erase(at);
    if (merged.kind != Node::Kind::sequence) return add_missing(mapping, std::move(merged));
    for (Node& item : merged.items) add_missing(mapping, std::move(item));
  }

  void add_missing(Node& mapping, Node other) {
    if (other.kind != Node::Kind::mapping) {
      if (!other.reported)
        report(other.position, description_of(other) + " behind the merge key '<<'",
               "an alias of a mapping, such as <<: *main, or a list of them");
      return;
    }
    std::unordered_set<std::string> own;
    for (const Entry& entry : mapping.entries) own.insert(entry.key);
    for (Entry& entry : other.entries) {
      if (!own.contains(entry.key)) mapping.entries.push_back(std::move(entry));
    }
    if (mapping.entries.size() > most_keys)
      throw TooLarge{mapping.position, "a mapping of more than 100000 keys", "at most 100000 keys"};
  }

  std::string file_;
  const std::string& source_;
  std::vector<Fault>& faults_;
  Node root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Node> anchors_;
  std::size_t count_ = 0, repeated_nodes_ = 0, repeated_bytes_ = 0;
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

/// A key of the block style that is open at some line: keys below it stand deeper.
struct OpenKey {
  std::size_t indentation = 0;
  int line = 0;  ///< from 1
  std::string key;
  bool has_value = false;  ///< on its own line: nothing may stand deeper
};

/// The key that a line begins with; empty where it begins with none.
std::string key_of_line(const std::string& line, std::size_t indentation, bool& has_value) {
  if (indentation >= line.size() || std::string_view("#-{}[],&*!|>'\"%@`").find(line[indentation]) != std::string::npos)
    return "";
  std::size_t colon = line.find(':', indentation);
  while (colon != std::string::npos && colon + 1 < line.size() && line[colon + 1] != ' ' && line[colon + 1] != '\r')
    colon = line.find(':', colon + 1);
  if (colon == std::string::npos) return "";
  const std::string key = line.substr(indentation, colon - indentation);
  if (key.find_first_of("#{}[],") != std::string::npos) return "";
  const std::size_t value = line.find_first_not_of(" \r", colon + 1);
  has_value = value != std::string::npos && line[value] != '#';
  return key;
}

std::string spaces_text(std::size_t count) {
  return count == 0 ? "no spaces" : std::to_string(count) + (count == 1 ? " space" : " spaces");
}

/// Of a line that stands as deep as no line that it could belong to, with what it could: nothing for other lines.
std::optional<Fault> indentation_fault(const std::string& text, int line, const std::string& file) {
  std::vector<OpenKey> open;
  std::istringstream stream(text);
  std::string content;
  for (int i = 1; i <= line && std::getline(stream, content); ++i) {
    const std::size_t indentation = content.find_first_not_of(' ');
    bool has_value = false;
    const std::string key = indentation == std::string::npos ? "" : key_of_line(content, indentation, has_value);
    if (key.empty()) continue;
    if (i < line) {
      while (!open.empty() && open.back().indentation >= indentation) open.pop_back();
      open.push_back({indentation, i, key, has_value});
      continue;
    }
    const bool is_aligned =
        std::any_of(open.begin(), open.end(), [&](const OpenKey& other) { return other.indentation == indentation; });
    const bool is_deepest = open.empty() || indentation > open.back().indentation;
    if (open.empty() || is_aligned || (is_deepest && !open.back().has_value)) return std::nullopt;
    std::string found = "'" + key + "' indented by " + spaces_text(indentation);
    if (is_deepest)
      found += ", deeper than '" + open.back().key + "' in line " + std::to_string(open.back().line) +
               ", which has a value already";
    std::string expected;
    constexpr std::size_t most = 3;
    for (std::size_t k = 0; k < std::min(open.size(), most); ++k) {
      const OpenKey& other = open[open.size() - 1 - k];
      expected += (k == 0 ? "" : ", or ") + spaces_text(other.indentation) + ", as '" + other.key + "' in line " +
                  std::to_string(other.line);
    }
    return Fault{{file, line, static_cast<int>(indentation) + 1},
                 "",
                 std::move(found),
                 std::move(expected),
                 "keys that belong together stand exactly below each other"};
  }
  return std::nullopt;
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
  const bool may_be_indentation = error.msg == YAML::ErrorMsg::MAP_VALUE || error.msg == YAML::ErrorMsg::END_OF_MAP;
  if (may_be_indentation && !has_tab)
    if (std::optional<Fault> fault = indentation_fault(text, error.mark.line + 1, file)) return *std::move(fault);
  std::string hint;
  if (has_tab)
    return {{file, error.mark.line + 1, error.mark.column + 1},
            "",
            "a tab before the text of its line",
            "spaces before it",
            "indent with spaces, not tabs"};
  if (line.find("${") != std::string::npos && line.find("\"${") == std::string::npos) {
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

Extent extent_of(const Node& node) {
  Extent extent{.text_bytes = node.text.size()};
  const auto add = [&extent](const Extent& part) {
    extent.nodes += part.nodes;
    extent.text_bytes += part.text_bytes;
    extent.key_bytes += part.key_bytes;
    extent.depth = std::max(extent.depth, 1 + part.depth);
  };
  for (const Node& item : node.items) add(extent_of(item));
  for (const Entry& entry : node.entries) {
    add(extent_of(entry.value));
    extent.key_bytes += entry.key.size();
  }
  return extent;
}

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
  } catch (const TooLarge& limit) {
    faults.push_back({limit.position, "", limit.found, limit.expected, ""});
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
