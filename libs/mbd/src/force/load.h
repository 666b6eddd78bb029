#pragma once

#include <vector>

#include "hersey/mbd/mechanism_spec.h"
#include "tree/assembly.h"

namespace hersey::mbd {

/// Connection of a load to the tree.
class Load {
 public:
  /// @param body  the body the load's frame is fixed on
  Load(const LoadSpec& spec, BodyId body, const Tree& tree);

  /// The wrench on the body, at ground's origin and in ground's axes.
  [[nodiscard]] Vector6 wrench(const TreeMotion& motion, const solver::State& state);

  /// Adds the wrench and its tangent (theory manual eq. (mechanisms.13)).
  void add(Assembly& assembly, const solver::State& state);

  /// Calls visit(row, column) for each tangent entry.
  template <class Visit>
  void visit_pattern(const Tree& tree, Visit visit) const {
    for (int row : tree.path[at_.link]) {
      for (int column : tree.path[at_.link]) visit(row, column);
      for (const Term& term : terms_)
        for (const Argument& x : term.arguments)
          if (x.kind != Variable::Kind::time) visit(row, x.column);
    }
  }

  [[nodiscard]] int link() const { return at_.link; }

 private:
  struct Argument {
    Variable::Kind kind;
    int q = 0;
    int column = 0;
  };
  struct Term {
    Vector6 direction;
    std::shared_ptr<const ScalarFunction> magnitude;
    std::vector<Argument> arguments;
    std::vector<double> values, gradient;
  };

  /// Axes of the directions at the load's point.
  [[nodiscard]] Pose axes(const TreeMotion& motion) const;
  static void read_arguments(Term& term, const solver::State& state);

  LoadAxes kind_;
  Attachment at_;
  Matrix3 R_LB_;  ///< the body's own axes on its link
  std::vector<Term> terms_;
};

}  // namespace hersey::mbd
