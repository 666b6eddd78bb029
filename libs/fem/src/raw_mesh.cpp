#include "raw_mesh.h"

#include <algorithm>

namespace hersey::fem {
namespace {

Fault fault(const RawMesh& raw, Place place, std::string found, std::string expected, std::string suggestion) {
  return {{raw.files[static_cast<std::size_t>(place.file)], place.line, 0},
          "",
          std::move(found),
          std::move(expected),
          std::move(suggestion)};
}

}  // namespace

void RawMesh::add_node(long label, const Vector3& r, Place place) {
  nodes.push_back(r);
  node_labels.push_back(label);
  node_places.push_back(place);
}

void RawMesh::add_element(ElementType type, long label, std::span<const long> element_nodes, Place place) {
  RawElement element;
  element.type = type;
  element.label = label;
  element.place = place;
  element.first = connectivity.size();
  elements.push_back(element);
  connectivity.insert(connectivity.end(), element_nodes.begin(), element_nodes.end());
}

void RawMesh::add_mark(long label, std::span<const long> mark_nodes, int corner_count) {
  RawMark mark;
  mark.label = label;
  mark.node_count = static_cast<int>(mark_nodes.size());
  mark.corner_count = corner_count;
  std::copy(mark_nodes.begin(), mark_nodes.end(), mark.nodes.begin());
  marks.push_back(mark);
}

void RawMesh::warn(Place place, std::string found, std::string expected, std::string suggestion) {
  warnings.push_back(fault(*this, place, std::move(found), std::move(expected), std::move(suggestion)));
}

void RawMesh::fail(Place place, std::string found, std::string expected, std::string suggestion) const {
  throw InputError(fault(*this, place, std::move(found), std::move(expected), std::move(suggestion)));
}

}  // namespace hersey::fem
