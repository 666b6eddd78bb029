#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tree/source_tree.h"

namespace hersey::model {

/// Parameters by name: those of a template, and outside of them those of the model.
class Scope {
 public:
  /// @param outer  where a name is looked for that is not here; null for none. Has to outlive the scope.
  explicit Scope(const Scope* outer = nullptr) : outer_(outer) {}

  /// Adds a parameter; one derived from others is replaced by its value.
  void define(const std::string& name, Node value);

  /// The parameter called `name`; null if there is none.
  [[nodiscard]] const Node* find(const std::string& name) const;

  /// All names, those outside too, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  const Scope* outer_;
  std::map<std::string, Node> parameters_;
};

/// Puts parameters into the texts of one document, whose length in all it limits.
class Substitution {
 public:
  explicit Substitution(std::vector<Fault>& faults) : faults_(faults) {}

  /// Replaces every ${name} in the scalars of `node`, which is called `path`, by the parameter of that name in `scope`.
  void visit(Node& node, const std::string& path, const Scope& scope);

  /// `key` with its parameters, as they are written. @param position  of the key
  [[nodiscard]] std::string in_key(const std::string& key, const SourcePosition& position, const std::string& path,
                                   const Scope& scope);

 private:
  void substitute(Node& node, const std::string& path, const Scope& scope);
  void report_unknown(Node& node, const std::string& path, const std::string& name, const Scope& scope);

  std::vector<Fault>& faults_;
  std::size_t in_all_ = 0;  // characters of values that have been put together
};

/// Defines the parameters of the model `root`, each of which may use those above it, in `scope`.
void define_parameters(Node& root, Substitution& substitution, Scope& scope);

/// Replaces every ${name} outside `parameters`, `templates` and `study`.
void substitute_parameters(Node& root, Substitution& substitution, const Scope& scope);

}  // namespace hersey::model
