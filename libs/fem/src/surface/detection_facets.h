#pragma once

#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// One outer face of a mesh with its geometry.
struct Facet {
  ElementFace face;
  std::vector<int> nodes;        ///< corners in order around the face, then the midside nodes of their edges
  std::size_t corners = 0;       ///< number of corners among `nodes`
  std::vector<Vector3> normals;  ///< outward unit normals at `nodes`
  Vector3 centre = Vector3::Zero(), normal = Vector3::Zero();  ///< centre, and outward normal there
  double area = 0;                                             ///< [m^2]
};

/// A facet beyond an edge.
struct FacetNeighbour {
  int facet = 0;
  int first = 0, last = 0;  ///< the edge's corners, indices in Mesh::nodes
  double angle = 0;         ///< largest one between the two facets' normals along the edge [rad]
};

/// The outer surface of a mesh as facets that know their neighbours.
struct SurfaceFacets {
  std::vector<Facet> facets;
  std::vector<std::vector<FacetNeighbour>>
      neighbours;  ///< neighbours of each facet; edges of more than two facets have none
};

/// @verified_by surface_detection_test.cpp
[[nodiscard]] SurfaceFacets surface_facets(const Mesh& mesh);

}  // namespace hersey::fem
