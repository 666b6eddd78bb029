// libFuzzer target of the reader of the format in its name.
// seeds: libs/fem/test/data/*.msh
#include "fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hersey::fem::fuzz_mesh(data, size, hersey::fem::MeshFormat::gmsh);
  return 0;
}
