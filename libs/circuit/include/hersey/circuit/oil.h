#pragma once

namespace hersey::circuit {

/// The oil of a circuit, the same in all of its elements.
struct Oil {
  double mu = 0.015;     ///< dynamic viscosity [Pa s], > 0
  double density = 850;  ///< [kg/m^3], > 0
};

/// A flow through an element and its derivative by the drop of pressure over it.
struct Flow {
  double value = 0;    ///< [m^3/s]
  double slope = 0;    ///< [m^3/(Pa s)]
  double by_area = 0;  ///< derivative by Setting::open_area [m/s]
};

/// What the machine makes of an element at an instant.
struct Setting {
  double speed = 0;      ///< of the shaft of a pump [rad/s]
  double open_area = 0;  ///< of a hole over a groove [m^2]
};

}  // namespace hersey::circuit
