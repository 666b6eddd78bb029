// Names of rows and the fixed patterns of the mechanism's matrices.
#include <fmt/format.h>

#include "hersey/mbd/mechanism.h"
#include "mechanism/mechanism_parts.h"

namespace hersey::mbd {
namespace {

/// "rotation", "position y": the part of a joint's coordinates that value `value` is.
std::string name_of_value(JointType type, int value) {
  for (const Coordinate& c : coordinates_of(type)) {
    if (value < c.offset || value >= c.offset + c.size) continue;
    if (c.size == 1) return std::string(c.name);
    return fmt::format("{} {}", c.name, "xyz"[value - c.offset]);
  }
  return {};
}

}  // namespace

std::string MechanismParts::name_of_velocity(Index row) const {
  for (const ElasticAssembly& elastic : elastics)
    if (const Index own = row - elastic.own_v(); row >= tree.nv && own < elastic.own_count())
      return fmt::format("body {}, mode {}", elastic.name(), own + 1);
  const Column& column = tree.columns[row];
  const Link& link = tree.links[column.link];
  const int value = link.value + column.component;
  if (link.joint < 0)
    return fmt::format("body {}, {}", spec.bodies[link.body].name, name_of_value(JointType::free, value));
  const JointSpec& joint = spec.joints[link.joint];
  return fmt::format("joint {}, {}", joint.name, name_of_value(joint.type, value));
}

std::string Mechanism::name_of_row(Index row) const {
  const MechanismParts& m = *parts_;
  if (row < nv()) return m.name_of_velocity(row);
  row -= nv();
  if (row >= m.row_of_drive(0)) return fmt::format("drive {}", m.spec.drives[row - m.row_of_drive(0)].name);
  if (row >= m.tree.nclosure) return fmt::format("coupling {}", m.spec.couplings[row - m.tree.nclosure].name);
  for (const Closure& closure : m.tree.closures) {
    const Index i = row - closure.first_row;
    if (i < 0 || i >= static_cast<Index>(closure.rows.size())) continue;
    const bool positional = closure.rows[i].kind == ConstraintRow::Kind::position;
    return fmt::format("joint {}, closing {}", m.spec.joints[closure.joint].name,
                       positional ? "position" : "orientation");
  }
  return {};
}

template <class Visit>
void MechanismParts::visit_surface_columns(std::size_t i, Visit visit) const {
  std::vector<int> own, pair;
  for (const int side : {sides[i].a, sides[i].b}) {
    if (side < 0) continue;
    const std::vector<int>& columns = elastics[static_cast<std::size_t>(side)].shape_columns().columns;
    own.insert(own.end(), columns.begin(), columns.end());
  }
  for (const SignedColumn& column : tree.forces[i].columns) pair.push_back(column.column);
  for (const int moved : own) {
    for (const int pushed : own) visit(pushed, moved);
    for (const int column : pair) {
      visit(column, moved);
      visit(moved, column);
    }
  }
}

void MechanismParts::make_patterns() {
  std::vector<Eigen::Triplet<double>> entries, constraint_entries;
  const auto visit = [&](Index row, Index column) { entries.emplace_back(row, column, 0.0); };
  const auto visit_constraint = [&](Index row, Index column) {
    constraint_entries.emplace_back(row, column, 0.0);
    visit(nv + row, column);
    visit(column, nv + row);
  };
  const auto visit_pair = [&](const Pair& pair) {
    for (const SignedColumn& row : pair.columns)
      for (const SignedColumn& column : pair.columns) visit(row.column, column.column);
  };
  for (int j = 0; j < tree.nv; ++j) {
    for (int k : tree.path[tree.columns[j].link]) {
      visit(j, k);
      visit(k, j);
    }
  }
  for (std::size_t i = 0; i < tree.forces.size(); ++i) {
    visit_pair(tree.forces[i]);
    visit_surface_columns(i, visit);
  }
  for (const ElasticAssembly& elastic : elastics) elastic.visit_pattern(visit);
  for (const Load& load : loads) load.visit_pattern(tree, visit);
  for (const Closure& closure : tree.closures) {
    visit_pair(closure.pair);
    for (std::size_t i = 0; i < closure.rows.size(); ++i)
      for (const SignedColumn& column : closure.pair.columns)
        visit_constraint(closure.first_row + static_cast<Index>(i), column.column);
  }
  for (std::size_t i = 0; i < couplings.size(); ++i)
    couplings[i].visit_columns([&](int column) {
      visit_constraint(row_of_coupling(i), column);
      visit(column, column);
    });
  for (std::size_t i = 0; i < drives.size(); ++i) visit_constraint(row_of_drive(i), drives[i].column);

  const Index n = nv + nlambda();
  pattern.resize(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  constraint_pattern.resize(nlambda(), nv);
  constraint_pattern.setFromTriplets(constraint_entries.begin(), constraint_entries.end());
}

}  // namespace hersey::mbd
