#include "mesh/mesh_ties.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "mesh/surface_tie.h"
#include "mesh/tie_rows.h"

namespace hersey::fem {
namespace {

constexpr double kMovedVisibly = 1e-6;  // of the body's size

class TieMaker {
 public:
  TieMaker(RawMesh& raw, Mesh& mesh, const TiedNodes& nodes)
      : raw_(raw),
        mesh_(mesh),
        nodes_(nodes),
        size_(size_of(mesh)),
        first_auxiliary_(3 * static_cast<int>(mesh.nodes.size())) {}

  void make(const std::vector<StraightNode>& straight) {
    for (const RawSurfaceTie& tie : raw_.surface_ties) add_surface_tie(tie);  // first: it may move nodes
    for (const RawRigidBody& body : raw_.rigid_bodies) add_rigid_body(body);
    for (const RawEquation& equation : raw_.equations) add_equation(equation);
    for (const RawTie& tie : raw_.ties) add_row(tie);
    rows_ = without_auxiliary(std::move(rows_), [this](int unknown) { return unknown >= first_auxiliary_; });
    for (const StraightNode& node : straight) add_straight(node);
    const EliminatedRows independent = eliminated(std::move(rows_), [](int) { return true; });
    for (std::size_t r = 0; r < independent.rows.size(); ++r)
      mesh_.ties.push_back(tie_of(independent.rows[r], independent.pivots[r]));
  }

 private:
  static double size_of(const Mesh& mesh) {
    Vector3 lower = mesh.nodes.front(), upper = lower;
    for (const Vector3& r : mesh.nodes) {
      lower = lower.cwiseMin(r);
      upper = upper.cwiseMax(r);
    }
    const double size = (upper - lower).norm();
    return size > 0 ? size : 1;
  }

  // Solved for its pivot, which comes first.
  static MeshTie tie_of(const TieRow& row, int pivot) {
    const double of_pivot = row.at(pivot);
    MeshTie tie{{pivot / 3, pivot % 3, 1}};
    for (const auto& [unknown, coefficient] : row)
      if (unknown != pivot) tie.push_back({unknown / 3, unknown % 3, coefficient / of_pivot});
    return tie;
  }

  // Rotations, and nodes of no element, are numbered behind the displacements of the mesh.
  int unknown_of(long node, bool is_rotation, int axis) {
    if (!is_rotation)
      if (const int index = nodes_.index_of(node); index >= 0) return 3 * index + axis;
    const auto [number, is_new] =
        auxiliary_.try_emplace({node, is_rotation, axis}, first_auxiliary_ + static_cast<int>(auxiliary_.size()));
    return number->second;
  }

  void add_row(const RawTie& tie) {
    TieRow row;
    for (const RawTieTerm& term : tie.terms)
      for (int axis = 0; axis < 3; ++axis)
        if (const double factor = term.factor[axis]; factor != 0)
          // Rotations are counted as the displacements they make at the body's size.
          row[unknown_of(term.node, term.is_rotation, axis)] += term.is_rotation ? factor / size_ : factor;
    rows_.push_back(std::move(row));
  }

  const Vector3& position_of(long node, FileLocation location) const {
    const Vector3* const r = nodes_.position(node);
    if (r == nullptr)
      raw_.fail(location, fmt::format("node {}, which the file does not contain", node), "nodes of the file");
    return *r;
  }

  const std::vector<int>& set_named(const std::string& name, FileLocation location) const {
    const auto set = mesh_.node_sets.find(name);
    if (set == mesh_.node_sets.end())
      raw_.fail(location, fmt::format("the set '{}', which the file does not define", name), "a set of its nodes");
    return set->second;
  }

  void add_rigid_body(const RawRigidBody& body) {
    std::set<int> members;
    for (const std::string& name : {body.node_set, body.element_set})
      if (!name.empty()) {
        const std::vector<int>& set = set_named(name, body.location);
        members.insert(set.begin(), set.end());
      }
    if (members.empty()) return;
    const long reference = raw_.new_reference();
    const Vector3 origin = body.reference ? position_of(*body.reference, body.location)
                                          : mesh_.nodes[static_cast<std::size_t>(*members.begin())];
    const auto tie = [&](long label, const Vector3& r) {
      for (int axis = 0; axis < 3; ++axis)
        raw_.add_rigid_tie(label, r, reference, origin, Vector3::Unit(axis), false, body.location);
    };
    for (const int n : members)
      tie(mesh_.node_labels[static_cast<std::size_t>(n)], mesh_.nodes[static_cast<std::size_t>(n)]);
    if (body.reference && !members.contains(nodes_.index_of(*body.reference))) tie(*body.reference, origin);
  }

  // A term of a set represents its nodes one by one, in ascending order; a single node is combined with each of them.
  void add_equation(const RawEquation& equation) {
    std::vector<std::vector<long>> members;
    std::size_t count = 1;
    for (const RawEquation::Term& term : equation.terms) {
      std::vector<long>& of_term = members.emplace_back();
      if (term.set.empty()) {
        (void)position_of(term.node, equation.location);
        of_term.push_back(term.node);
        continue;
      }
      for (const int n : set_named(term.set, equation.location))
        of_term.push_back(mesh_.node_labels[static_cast<std::size_t>(n)]);
      std::sort(of_term.begin(), of_term.end());
      if (count > 1 && of_term.size() > 1 && of_term.size() != count)
        raw_.fail(equation.location, fmt::format("an equation between sets of {} and {} nodes", count, of_term.size()),
                  "sets of equally many nodes, which are paired one by one");
      count = std::max(count, of_term.size());
    }
    for (const std::vector<long>& of_term : members)
      if (of_term.empty()) return;
    for (std::size_t k = 0; k < count; ++k) {
      RawTie tie{equation.location, {}};
      for (std::size_t t = 0; t < equation.terms.size(); ++t) {
        const RawEquation::Term& term = equation.terms[t];
        const long node = members[t][members[t].size() == 1 ? 0 : k];
        refuse_own_axes(node, equation.location);
        tie.terms.push_back({node, term.component >= 3, term.coefficient * Vector3::Unit(term.component % 3)});
      }
      raw_.ties.push_back(std::move(tie));
    }
  }

  void refuse_own_axes(long node, FileLocation location) const {
    const int at = nodes_.index_of(node);
    for (const std::string& name : raw_.transformed_sets) {
      const auto set = mesh_.node_sets.find(name);
      if (at >= 0 && set != mesh_.node_sets.end() && std::binary_search(set->second.begin(), set->second.end(), at))
        raw_.fail(location,
                  fmt::format("an equation of node {}, whose axes *TRANSFORM rotates by the set '{}'", node, name),
                  "equations in the axes of the mesh", "write the equation without *TRANSFORM");
    }
  }

  void add_straight(const StraightNode& node) {
    const int middle = nodes_.index_of(node.node), a = nodes_.index_of(node.corners[0]),
              b = nodes_.index_of(node.corners[1]);
    if (middle < 0 || a < 0 || b < 0) return;
    for (int axis = 0; axis < 3; ++axis)
      rows_.push_back({{3 * middle + axis, 1}, {3 * a + axis, -0.5}, {3 * b + axis, -0.5}});
  }

  void add_surface_tie(const RawSurfaceTie& tie) {
    const auto master = mesh_.surfaces.find(tie.master);
    if (master == mesh_.surfaces.end() || master->second.empty())
      raw_.fail(tie.location, fmt::format("a tie to '{}', which has no faces", tie.master),
                "a surface of faces of solids behind the comma: slave, master");
    const SurfaceTie made =
        tie_to_faces(mesh_, set_named(tie.slave, tie.location), master->second, {tie.tolerance, tie.adjusts});
    for (const MeshTie& of_axis : made.ties) {
      TieRow row;
      for (const TieTerm& term : of_axis) row[3 * term.node + term.axis] += term.coefficient;
      rows_.push_back(std::move(row));
    }
    if (!made.loose.empty())
      raw_.warn(
          tie.location,
          fmt::format("{} nodes of '{}' farther than {:.4g} from '{}'; the first is {}", made.loose.size(), tie.slave,
                      made.tolerance, tie.master, mesh_.node_labels[static_cast<std::size_t>(made.loose.front())]),
          "nodes on the faces they are tied to", "they are not tied; a larger POSITION TOLERANCE ties them");
    if (made.moved > kMovedVisibly * size_)
      raw_.warn(tie.location, fmt::format("nodes of '{}' up to {:.4g} beside '{}'", tie.slave, made.moved, tie.master),
                "nodes on the faces they are tied to", "they are put there; ADJUST=NO leaves them where they are");
  }

  RawMesh& raw_;
  Mesh& mesh_;
  const TiedNodes& nodes_;
  double size_;
  int first_auxiliary_;
  std::map<std::tuple<long, bool, int>, int> auxiliary_;
  std::vector<TieRow> rows_;
};

}  // namespace

void add_ties(RawMesh& raw, Mesh& mesh, const TiedNodes& nodes, const std::vector<StraightNode>& straight) {
  if (mesh.nodes.empty()) return;
  TieMaker(raw, mesh, nodes).make(straight);
}

}  // namespace hersey::fem
