#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/skin.h"

namespace hersey::fem {

/// For any bytes, a reader either returns a mesh whose quality can be computed or throws InputError.
inline void fuzz_mesh(const std::uint8_t* data, std::size_t size, MeshFormat format) {
  const std::string text(data, data + size);
  try {
    std::vector<Fault> warnings;
    const Mesh mesh = parse_mesh(text, format, "fuzz", 1e-3, &warnings);
    const MeshQuality quality = quality_of(mesh);
    (void)faults_of(quality, "fuzz");
    (void)warnings_of(quality, "fuzz");
    (void)skin(mesh);
  } catch (const InputError&) {
    // the expected answer to nearly every input
  }
}

}  // namespace hersey::fem
