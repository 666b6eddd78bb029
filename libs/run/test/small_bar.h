#pragma once

#include <filesystem>
#include <fstream>

namespace hersey::run {

/// A bar of `cells` hexahedra, 20 mm long each and 10 mm wide, with sets on its ends.
inline void write_bar(const std::filesystem::path& path, int cells) {
  std::ofstream file(path);
  file << "*NODE\n";
  for (int i = 0; i <= cells; ++i)
    for (int corner = 0; corner < 4; ++corner)
      file << 4 * i + corner + 1 << ", " << 20 * i << ", " << (corner % 3 == 0 ? 0 : 10) << ", "
           << (corner < 2 ? 0 : 10) << "\n";
  file << "*ELEMENT, TYPE=C3D8I, ELSET=all\n";
  for (int i = 0; i < cells; ++i) {
    file << i + 1;
    for (int corner = 0; corner < 4; ++corner) file << ", " << 4 * i + corner + 1;
    for (int corner = 0; corner < 4; ++corner) file << ", " << 4 * i + corner + 5;
    file << "\n";
  }
  file << "*NSET, NSET=left\n1, 2, 3, 4\n*NSET, NSET=right\n";
  for (int corner = 0; corner < 4; ++corner) file << 4 * cells + corner + 1 << (corner < 3 ? ", " : "\n");
  file << "*NSET, NSET=pad\n";  // on the upper side, at the right end
  for (int i = cells - 2; i <= cells; ++i) file << 4 * i + 2 << ", " << 4 * i + 3 << (i < cells ? ", " : "\n");
}

inline const char* const kPendulum = R"(hersey: 1
title: A pendulum that bends
gravity: 0 -9.81 0 m/s^2
bodies:
  bar:
    flexible:
      mesh: bar.inp
      length_unit: 1 mm
      material: {youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1200 kg/m^3}
      modes: 4
      damping: {stiffness: 50 us}
      vtu_every: 10 ms
    frames:
      root: {nodes: left}
      tip: {nodes: right}
joints:
  hinge: {type: revolute, between: [ground, bar.root]}
simulation: {duration: 50 ms, step: 0.1 ms}
)";

}  // namespace hersey::run
