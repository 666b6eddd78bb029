#include "hersey/model/convert.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>

#include "tree/source_tree.h"

namespace hersey::model {
namespace {

constexpr const char* kBlanks = " \t";
constexpr const char* kWhitespace = " \t\r\n";

/// "sae_5w30" for "sae_5w_30", an earlier spelling; empty for anything else.
std::string new_grade(const std::string& text) {
  const std::size_t w = text.find("w_");
  if (!text.starts_with("sae_") || w == std::string::npos) return "";
  const std::string winter = text.substr(4, w - 4), summer = text.substr(w + 2);
  const auto is_number = [](const std::string& digits) {
    return !digits.empty() && digits.size() <= 2 &&
           std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  return is_number(winter) && is_number(summer) ? "sae_" + winter + "w" + summer : "";
}

/// Collects what is to be changed in a text from its tree, and changes it.
class Converter {
 public:
  explicit Converter(const std::string& text) : text_(text), lines_{0} {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') lines_.push_back(i + 1);
    }
  }

  Conversion convert(const Node& root) {
    collect_keys(root);
    visit(root, "", "");
    Conversion conversion{.text = text_, .changes = {}};
    for (const auto& [at, edit] : edits_) {
      conversion.text.replace(at, edit.length, edit.replacement);
      conversion.changes.push_back(edit.change);
    }
    std::reverse(conversion.changes.begin(), conversion.changes.end());
    return conversion;
  }

 private:
  struct Edit {
    std::size_t length = 0;
    std::string replacement;
    Change change;
  };

  void collect_keys(const Node& node) {
    for (const Node& item : node.items) collect_keys(item);
    for (const Entry& entry : node.entries) {
      keys_.insert(entry.key);
      collect_keys(entry.value);
    }
  }

  /// `key` is that of the mapping's entry whose value `node` is, or whose list holds it.
  void visit(const Node& node, const std::string& path, const std::string& key) {
    if (node.kind == Node::Kind::scalar) rename_grade(node, path, key);
    for (std::size_t i = 0; i < node.items.size(); ++i) visit(node.items[i], path + "." + std::to_string(i), key);
    for (const Entry& entry : node.entries) {
      const std::string inner = path.empty() ? entry.key : path + "." + entry.key;
      if (key == "coupling" && entry.key == "tolerance")
        remove(entry, {entry.position, inner, "removed: bodies and film agree to the simulation's one tolerance"});
      else
        visit(entry.value, inner, entry.key);
    }
  }

  /// Of an oil, or of a parameter or a study's value that becomes one; an oil may also be called so.
  void rename_grade(const Node& node, const std::string& path, const std::string& key) {
    const std::string grade = new_grade(node.text);
    const bool may_be_a_name = key != "grade" && keys_.contains(node.text);
    if (grade.empty() || may_be_a_name || node.text_offset < 0) return;
    const std::size_t at = offset(node.position) + static_cast<std::size_t>(node.text_offset);
    add(at, {node.text.size(), grade, {node.position, path, node.text + " is written " + grade}});
  }

  /// A key with one value: with its line where it has one, else with a comma.
  void remove(const Entry& entry, const Change& change) {
    if (entry.value.kind != Node::Kind::scalar || entry.value.text_offset < 0) return;
    std::size_t begin = offset(entry.position);
    std::size_t end = offset(entry.value.position) + entry.value.text.size() +
                      2 * static_cast<std::size_t>(entry.value.text_offset);  // quotes
    const std::size_t line = lines_[static_cast<std::size_t>(entry.position.line) - 1];
    const std::size_t rest = std::min(text_.find_first_not_of(kBlanks, end), text_.size());
    const bool is_alone = text_.find_first_not_of(kBlanks, line) == begin &&
                          (rest == text_.size() || text_[rest] == '#' || text_[rest] == '\r' || text_[rest] == '\n');
    if (is_alone) {
      begin = line;
      end = std::min(text_.find('\n', rest), text_.size() - 1) + 1;
    } else if (rest < text_.size() && text_[rest] == ',') {
      end = std::min(text_.find_first_not_of(kBlanks, rest + 1), text_.size());
    } else {
      const std::size_t before = text_.find_last_not_of(kWhitespace, begin - 1);
      if (before != std::string::npos && text_[before] == ',') begin = before;
    }
    add(begin, {end - begin, "", change});
  }

  /// Once for all that aliases repeat.
  void add(std::size_t at, Edit edit) { edits_.emplace(at, std::move(edit)); }

  [[nodiscard]] std::size_t offset(const SourcePosition& position) const {
    return lines_[static_cast<std::size_t>(position.line) - 1] + static_cast<std::size_t>(position.column) - 1;
  }

  const std::string& text_;
  std::vector<std::size_t> lines_;  // where each begins
  std::set<std::string> keys_;
  std::map<std::size_t, Edit, std::greater<>>
      edits_;  // edits by location, the last first, so that locations before an edit stay valid
};

}  // namespace

Conversion converted(const std::string& text, const std::string& file) {
  std::vector<Fault> faults;
  const std::optional<Node> root = parse_yaml(text, file, faults);
  if (!root) throw InputError(std::move(faults));
  return Converter(text).convert(*root);
}

}  // namespace hersey::model
