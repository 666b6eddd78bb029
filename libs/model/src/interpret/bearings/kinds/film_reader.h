#pragma once

#include <optional>
#include <string>

#include "interpret/context/interpret.h"

namespace hersey::model {

/// Names and size of a kind's surfaces.
struct SurfaceNames {
  std::string fixed = "shell", moving = "journal";  ///< keys of `roughness` and `materials`
  double size = 0;  ///< length in which an elastic column is measured: a journal's radius, a pad's length [m]
};

/// Reads what the films of all kinds of bearing share: oil, cavitation, roughness, contact, compliance.
class FilmReader {
 public:
  /// Keeps references to all of them.
  FilmReader(Context& context, const Value& value, Bearing& bearing);

  /// Sets the names and the size before the keys of surfaces are read.
  void set_surfaces(SurfaceNames surfaces);
  void read_lubricant();
  void read_cavitation();  ///< and the oil with which a run begins
  /// Returns the edge with what lies outside it, a pressure or `closed`.
  [[nodiscard]] film::Edge edge_of(const Value& outside);
  /// Reads all the oil that reaches an edge; reports edges that are not at the cavitation pressure.
  void read_edge_flow(const Value& flow, film::Edge& edge);
  /// Reads roughness, asperities, compliance and wear, and reports materials that nothing uses.
  void read_contact();
  /// Reads the scale of pressures; reports those below a vacuum.
  void read_pressure_scale();
  /// Reads how the film is sheared, turbulence included. Oil, roughness and the film's surface come before.
  void read_shear();
  /// Reads `temperature` of a bearing whose oil has one temperature, and puts the oil at it.
  void read_temperature();
  /// Reads `thermal` of a film between pads and a runner, all else of which has been read.
  void read_heat();
  /// Reports absolute pressures of a pad: the atmosphere acts on its back, too, so that a load is what the film has
  /// above it.
  void require_gauge_pressures();
  /// Reads `pressure` of a hole or pocket, once its depth is known, and appends it to the pressures of features.
  void read_feed(const Value& value, film::SurfaceFeature& feature);
  /// Returns the pressure of a feature that is not fed.
  [[nodiscard]] Function not_fed(const std::string& path) const;
  /// Reports a film that loses its oil for good: `edges` at the cavitation pressure and nothing that feeds it.
  void warn_of_starvation(const std::vector<film::Edge>& edges);

  /// The oil; null if there is none of that name.
  [[nodiscard]] const Lubricant* lubricant() const { return lubricant_; }

 private:
  /// True if the film has temperatures.
  [[nodiscard]] bool is_warm() const;
  void read_port(const Value& node, const Value* pressure, film::SurfaceFeature& feature);
  void read_turbulence();
  void check_turbulence(const Value& turbulence);
  void read_roughness();
  void read_asperities();
  void read_summits(const Value& asperities);
  void read_compliance();
  void read_wear();
  bearing::SurfaceWear wear_of(const Value& wear, const std::string& surface);
  bearing::RunningIn running_in_of(const Value& run_in);
  void require_use_of_materials();
  std::optional<double> composite_modulus_of(const Value& parent);

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
  SurfaceNames surfaces_;
  const Lubricant* lubricant_ = nullptr;
  const Value* given_modulus_ = nullptr;  ///< a `composite_modulus`; null: none is given
  bool takes_materials_ = false;          ///< some modulus is to come from `materials`
};

/// Reports films that are to wear one moving surface and cannot. All bearings have been read.
void check_worn_groups(Context& context);

/// Returns the coupling of a bearing to its bodies.
[[nodiscard]] Coupling coupling_of(const Value& bearing);

/// Returns a member that is given and is not the word "none"; null if there is none.
[[nodiscard]] const Value* given(const Value& parent, const std::string& key);

/// Reports a load beyond what any solid bears on `area` [m^2], a slip of units.
void require_bearable(Context& context, const Value& load, double area);

/// Reads the frames of the fixed and of the moving surface; reports frames of one body.
void read_frames(Context& context, const Value& value, const SurfaceNames& surfaces, Bearing& bearing);

}  // namespace hersey::model
