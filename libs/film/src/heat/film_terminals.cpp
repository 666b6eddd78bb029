#include "hersey/film/film_terminals.h"

#include <algorithm>
#include <variant>

namespace hersey::film {
namespace {

using Eigen::Index;

std::optional<std::size_t> node_of(const std::optional<NetworkNode>& node) {
  return node ? std::optional(node->node) : std::nullopt;
}

}  // namespace

Index FilmTerminals::index_of_oil(const std::optional<NetworkNode>& from) const {
  if (!from) return -1;
  const auto found = std::find(oil.begin(), oil.end(), from->node);
  return found == oil.end() ? -1 : outside() - static_cast<Index>(oil.end() - found);
}

std::vector<std::pair<Index, Index>> FilmTerminals::nodes() const {
  std::vector<std::pair<Index, Index>> all;
  if (shell) all.emplace_back(0, static_cast<Index>(*shell));
  if (journal) all.emplace_back(1, static_cast<Index>(*journal));
  Index terminal = 2;
  if (ambient) all.emplace_back(terminal++, static_cast<Index>(*ambient));
  if (drain) all.emplace_back(terminal++, static_cast<Index>(*drain));
  for (const std::size_t node : oil) all.emplace_back(terminal++, static_cast<Index>(node));
  return all;
}

FilmTerminals terminals_of(const ThermalModel& thermal) {
  FilmTerminals at;
  if (const auto* shell = std::get_if<NodeWall>(&thermal.shell)) at.shell = shell->node;
  if (const auto* journal = std::get_if<NodeWall>(&thermal.journal)) at.journal = journal->node;
  if (const auto* ring = std::get_if<RingWall>(&thermal.shell)) at.ambient = node_of(ring->surroundings);
  at.drain = node_of(thermal.oil.drain);
  const auto come_from = [&at](const std::optional<NetworkNode>& node) {
    if (node && at.index_of_oil(node) < 0) at.oil.push_back(node->node);
  };
  come_from(thermal.oil.line);
  for (const auto& feature : thermal.oil.features) come_from(feature);
  come_from(thermal.oil.edges);
  return at;
}

Eigen::VectorXd outside_at_start(const ThermalModel& thermal) {
  const FilmTerminals at = terminals_of(thermal);
  Eigen::VectorXd T = Eigen::VectorXd::Constant(at.outside(), thermal.T_supply);
  if (at.ambient) T[at.index_of_ambient()] = std::get<RingWall>(thermal.shell).T_ambient;
  if (at.drain) T[at.index_of_drain()] = thermal.oil.drain->T;
  const auto begin = [&](const std::optional<NetworkNode>& node) {
    if (node) T[at.index_of_oil(node)] = node->T;
  };
  begin(thermal.oil.line), begin(thermal.oil.edges);
  for (const auto& feature : thermal.oil.features) begin(feature);
  return T;
}

}  // namespace hersey::film
