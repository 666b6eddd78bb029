#pragma once

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace hersey {

/// A ring of hexahedra about the z-axis, in the format of Abaqus, its middle in the origin.
struct RingFile {
  double inner = 22.5, outer = 30, width = 15.6;  ///< radii and width [mm]
  int around = 24, along = 3, through = 1;        ///< elements

  /// With sets `bore`, `outside`, `ends`, and `foot`: three nodes around on the outside, all along.
  [[nodiscard]] std::string text() const {
    std::ostringstream nodes, elements, bore, outside, ends, foot;
    nodes.precision(12);
    nodes << "*NODE\n";
    for (int k = 0; k <= along; ++k)
      for (int i = 0; i < around; ++i)
        for (int layer = 0; layer <= through; ++layer) {
          const double phi = 2 * std::numbers::pi * i / around, r = inner + (outer - inner) * layer / through;
          nodes << label(layer, i, k) << ", " << r * std::cos(phi) << ", " << r * std::sin(phi) << ", "
                << width * k / along - width / 2 << "\n";
          if (layer == 0) bore << label(layer, i, k) << ",\n";
          if (layer == through) outside << label(layer, i, k) << ",\n";
          if (k == 0 || k == along) ends << label(layer, i, k) << ",\n";
          if (layer == through && i < 3) foot << label(layer, i, k) << ",\n";
        }
    elements << "*ELEMENT, TYPE=C3D8, ELSET=all\n";
    int element = 0;
    for (int k = 0; k < along; ++k)
      for (int i = 0; i < around; ++i)
        for (int layer = 0; layer < through; ++layer) {
          elements << ++element;
          for (const int z : {k, k + 1})
            elements << ", " << label(layer, i, z) << ", " << label(layer + 1, i, z) << ", "
                     << label(layer + 1, i + 1, z) << ", " << label(layer, i + 1, z);
          elements << "\n";
        }
    return nodes.str() + elements.str() + "*NSET, NSET=bore\n" + bore.str() + "*NSET, NSET=outside\n" + outside.str() +
           "*NSET, NSET=ends\n" + ends.str() + "*NSET, NSET=foot\n" + foot.str();
  }

 private:
  [[nodiscard]] int label(int layer, int i, int k) const {
    return 1 + layer + (through + 1) * ((i % around) + around * k);
  }
};

}  // namespace hersey
