#include "force/load.h"

namespace hersey::mbd {

Load::Load(const LoadSpec& spec, BodyId body, const Tree& tree)
    : kind_(spec.axes), at_(tree.frames[spec.frame.index]), R_LB_(tree.bodies[body.index].X_LF.R) {
  for (const LoadTerm& given : spec.terms) {
    Term term{given.direction, given.magnitude, {}, {}, {}};
    for (const Variable& x : given.variables) {
      Argument argument{x.kind};
      if (x.kind != Variable::Kind::time) {
        argument.column = column_of(tree, x.coordinate);
        argument.q = tree.links[tree.columns[argument.column].link].first_q;
      }
      term.arguments.push_back(argument);
    }
    term.values.resize(term.arguments.size());
    term.gradient.resize(term.arguments.size());
    terms_.push_back(std::move(term));
  }
}

void Load::read_arguments(Term& term, const solver::State& state) {
  for (std::size_t i = 0; i < term.arguments.size(); ++i) {
    const Argument& x = term.arguments[i];
    term.values[i] = x.kind == Variable::Kind::time       ? state.t
                     : x.kind == Variable::Kind::position ? state.q[x.q]
                                                          : state.v[x.column];
  }
}

Pose Load::axes(const TreeMotion& motion) const {
  Pose X = motion.pose(at_);
  X.R = kind_ == LoadAxes::ground ? Matrix3(Matrix3::Identity()) : Matrix3(motion.X(at_.link).R * R_LB_);
  return X;
}

Vector6 Load::wrench(const TreeMotion& motion, const solver::State& state) {
  Vector6 local = Vector6::Zero();
  for (Term& term : terms_) {
    read_arguments(term, state);
    local += term.direction * term.magnitude->value(term.values);
  }
  return force_transform(axes(motion)) * local;
}

void Load::add(Assembly& assembly, const solver::State& state) {
  const Tree& tree = assembly.tree;
  const TreeMotion& motion = assembly.motion;
  const std::vector<int>& path = tree.path[at_.link];
  const Pose X = axes(motion);
  const Vector6 W = wrench(motion, state);
  for (int row : path) assembly.add_residual(row, -motion.J(row).dot(W), magnitude(motion.J(row), W));
  if (!assembly.tangent) return;

  for (int col : path) {
    const Vector6& J_k = assembly.directions[col].J;
    // Body axes rotate with the body; in ground's axes only the point moves, by v + omega x r.
    Vector6 dW;
    if (kind_ == LoadAxes::body) {
      dW = cross_force(J_k, W);
    } else {
      dW << (J_k.tail<3>() + J_k.head<3>().cross(X.r)).cross(W.tail<3>()), Vector3::Zero();
    }
    for (int row : path) {
      double value = motion.J(row).dot(dW);
      if (tree.moves(col, tree.columns[row].link)) value += cross_motion(J_k, motion.J(row)).dot(W);
      assembly.add_tangent(row, col, -value);
    }
  }
  for (Term& term : terms_) {
    if (term.arguments.empty()) continue;
    term.magnitude->gradient(term.values, term.gradient);
    const Vector6 unit = force_transform(X) * term.direction;
    for (std::size_t i = 0; i < term.arguments.size(); ++i) {
      const Argument& x = term.arguments[i];
      if (x.kind == Variable::Kind::time) continue;
      const double rate = x.kind == Variable::Kind::position ? assembly.stage.k : assembly.stage.c;
      for (int row : path) assembly.add_tangent(row, x.column, -motion.J(row).dot(unit) * term.gradient[i] * rate);
    }
  }
}

}  // namespace hersey::mbd
