#pragma once

#include "hersey/fem/reduction.h"
#include "reduction/hdf5_file.h"

namespace hersey::fem {

/// Writes elements, sets, surfaces and materials of the mesh that `body` was made from, where it has elements.
void write_mesh_data(Hdf5File& file, const ReducedBody& body);

/// Reads them into `body`, whose nodes are there already; a file without elements leaves the nodes alone.
/// @throws std::runtime_error naming the data set that does not fit
void read_mesh_data(const Hdf5File& file, ReducedBody& body);

}  // namespace hersey::fem
