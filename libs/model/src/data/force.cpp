#include "hersey/model/force.h"

#include <type_traits>

namespace hersey::model {
namespace {

/// Function of time in a force's data, a T or a const T.
template <class T, class Take>
void visit_functions(T& data, const std::string& name, Take take) {
  using Data = std::remove_const_t<T>;
  if constexpr (std::is_same_v<Data, BodyLoad>) {
    for (auto& function : data.functions)
      take(function, data.is_torque ? "N.m" : "N", (data.is_torque ? "torque " : "force ") + name);
  } else if constexpr (std::is_same_v<Data, SurfaceLoad>) {
    for (auto& function : data.functions)
      take(function, data.is_pressure ? "Pa" : "N", (data.is_pressure ? "pressure " : "force ") + name);
  } else if constexpr (std::is_same_v<Data, PistonRing>) {
    if (data.gas) take(*data.gas, "Pa", "gas pressure of ring " + name);
  } else if constexpr (std::is_same_v<Data, SpeedControl>) {
    take(data.speed, speed_unit(data.on.coordinate), "wanted speed of " + name);
  }
}

template <class F, class AForce>
std::vector<ForceFunction<F>> all_functions(AForce& force) {
  std::vector<ForceFunction<F>> all;
  const auto take = [&](F& function, const std::string& unit, const std::string& text) {
    all.push_back({&function, unit, text});
  };
  std::visit([&](auto& data) { visit_functions(data, force.name, take); }, force.data);
  return all;
}

}  // namespace

std::vector<ForceFunction<Function>> functions_of(Force& force) { return all_functions<Function>(force); }

std::vector<ForceFunction<const Function>> functions_of(const Force& force) {
  return all_functions<const Function>(force);
}

std::vector<FrameName> frames_of(const Force& force) {
  return std::visit(
      [](const auto& data) -> std::vector<FrameName> {
        if constexpr (requires { data.at; }) return {data.at};
        if constexpr (requires { data.from; }) return {data.from, data.to};
        return {};
      },
      force.data);
}

}  // namespace hersey::model
