#include "interpret/bearings/kinds/journal_arcs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/core/two_pi.h"
#include "hersey/film/gap_shape.h"

// A bore that consists of arcs, from the values of its mapping.
namespace hersey::model {
namespace {

constexpr double degrees_in_radian = 180 / std::numbers::pi;

// Ends that meet to this angle leave no film between them [rad].
constexpr double same_angle = 1e-9;

/// One arc with the ends of its film, and where the model says so.
struct ArcAt {
  film::Arc arc;
  film::PatchEnds ends;
  const Value* value = nullptr;
  std::string name;
};

std::string range_text(const film::Arc& arc) {
  return fmt::format("{:.5g} to {:.5g} deg", degrees_in_radian * arc.from, degrees_in_radian * arc.to);
}

class ArcReader {
 public:
  ArcReader(Context& context, const Value& value, Bearing& bearing, FilmReader& reader)
      : context_(context), value_(value), film_(bearing.film), reader_(reader) {}

  void read() {
    const Value *bore = value_.find("bore"), *arcs = value_.find("arcs");
    if (bore != nullptr && arcs != nullptr) {
      context_.fault_at_key(*arcs, "both 'bore' and 'arcs'", "one of them",
                            "'bore' stands for equal arcs, 'arcs' gives each by itself");
      return;
    }
    if (bore != nullptr && !bore->broken) read_bore(*bore);
    for (const auto& [name, arc] : section(value_, "arcs"))
      if (!arc.broken) read_arc(arc, name);
    if (found_.empty() || context_.has_fault_in(value_.path)) return;
    put_in_order();
    if (!fits_a_circle()) return;
    film::Arcs profile;
    for (const ArcAt& at : found_) {
      profile.arcs.push_back(at.arc);
      film_.ends.push_back(at.ends);
    }
    film_.profiles.push_back({std::move(profile), film::Surface::shell});
  }

 private:
  void read_bore(const Value& value) {
    const std::string& type = value.text;
    const int count = type == "three_lobe"  ? 3
                      : type == "four_lobe" ? 4
                      : type == "lobes"     ? std::max(1, integer_of(value, "count"))
                                            : 2;
    const double arc = two_pi / count - number_of(value, "groove");
    if (arc <= 0) {
      context_.fault(*value.find("groove"),
                     fmt::format("grooves of {:.4g} deg, which leave nothing of {} arcs",
                                 degrees_in_radian * number_of(value, "groove"), count),
                     fmt::format("less than {:.4g} deg", 360.0 / count));
      return;
    }
    const double c_p = machined_clearance(value, film_.c);
    for (int k = 0; k < count; ++k)
      add(value, fmt::format("{}", k + 1), number_of(value, "angle") + two_pi * k / count, arc, film_.c, c_p);
  }

  void read_arc(const Value& value, const std::string& name) {
    const double c_b = value.find("radial_clearance") != nullptr ? number_of(value, "radial_clearance") : film_.c;
    const Value *preload = value.find("preload"), *machined = value.find("machined_clearance");
    if (preload != nullptr && machined != nullptr) {
      context_.fault_at_key(*machined, "both 'preload' and 'machined_clearance'", "one of them",
                            "preload = 1 - radial_clearance/machined_clearance");
      return;
    }
    const double c_p = machined != nullptr ? number_of(value, "machined_clearance") : machined_clearance(value, c_b);
    add(value, name, number_of(value, "middle"), number_of(value, "arc"), c_b, c_p);
  }

  /// The arc's own clearance c_p by its preload.
  double machined_clearance(const Value& value, double c_b) {
    const Value* preload = value.find("preload");
    if (preload == nullptr || preload->broken) return c_b;
    if (preload->number < 1) return c_b / (1 - preload->number);
    context_.fault(*preload, fmt::format("a preload of {:g}", preload->number),
                   "below 1: at 1 the arc touches the journal");
    return c_b;
  }

  void add(const Value& value, const std::string& name, double middle, double extent, double c_b, double c_p) {
    ArcAt at{.arc = {}, .ends = ends_of(value), .value = &value, .name = name};
    film::Arc& arc = at.arc;
    // The first end lies within half a turn on either side of the x-axis.
    arc.name = name;
    arc.from = std::remainder(middle - 0.5 * extent, two_pi);
    arc.to = arc.from + extent;
    arc.thinnest = arc.from + number_of(value, "offset") * extent;
    arc.offset = c_p - c_b;
    arc.extra_clearance = c_b - film_.c;
    found_.push_back(std::move(at));
  }

  film::PatchEnds ends_of(const Value& value) {
    film::PatchEnds ends;
    const auto of_both = [&](const char* key, const auto& read) {
      const Value* given = value.find(key);
      if (given == nullptr || given->broken || given->members.empty()) return;
      const Value& content = given->members.front().value;
      const Value *leading = content.find("leading"), *trailing = content.find("trailing");
      const bool is_pair = leading != nullptr && trailing != nullptr;
      read(is_pair ? *leading : content, ends.first);
      read(is_pair ? *trailing : content, ends.last);
    };
    of_both("edge_pressure", [&](const Value& v, film::Edge& edge) {
      if (!v.broken) edge = reader_.edge_of(v);
    });
    for (film::Edge* edge : {&ends.first, &ends.last})
      if (edge->kind == film::EdgeKind::pressure) edge->ambient_fill = 1;
    of_both("ambient_fill", [&](const Value& v, film::Edge& edge) { read_fill(v, edge); });
    of_both("edge_flow", [&](const Value& v, film::Edge& edge) { reader_.read_edge_flow(v, edge); });
    const Value *flow = given(value, "edge_flow"), *fill = given(value, "ambient_fill");
    if (flow != nullptr && fill != nullptr)
      context_.fault_at_key(*flow, "both 'edge_flow' and 'ambient_fill'", "one of them",
                            "the film draws from the groove what there is, or what reaches it");
    return ends;
  }

  void read_fill(const Value& value, film::Edge& edge) {
    if (value.broken) return;
    if (edge.kind == film::EdgeKind::closed) return;
    edge.ambient_fill = value.number;
    if (value.number == 1) return;
    if (!film::cavitation_law(film_).has_fill()) {
      context_.fault(value, "a fill fraction in a groove beside a film that has none inside",
                     "cavitation: mass_conserving, or no ambient_fill");
    } else if (edge.pressure > film_.p_cav) {
      context_.fault(value, fmt::format("{:g} in a groove above the cavitation pressure", value.number),
                     "1: such a groove is flooded");
    }
  }

  void put_in_order() {
    std::sort(found_.begin(), found_.end(), [](const ArcAt& a, const ArcAt& b) { return a.arc.from < b.arc.from; });
  }

  /// True if no two arcs overlap; reports those that do.
  bool fits_a_circle() {
    bool fits = true;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      const ArcAt& at = found_[k];
      const bool is_last = k + 1 == found_.size();
      const ArcAt& next = found_[is_last ? 0 : k + 1];
      const double begins = next.arc.from + (is_last ? two_pi : 0);
      if (at.arc.to <= begins + same_angle) continue;
      fits = false;
      if (found_.size() == 1) {
        context_.fault_at_key(*at.value, "an arc of more than 360 deg", "at most 360 deg");
      } else {
        context_.fault_at_key(*at.value,
                              fmt::format("arc '{}' ({}) overlaps '{}' ({})", at.name, range_text(at.arc), next.name,
                                          range_text(next.arc)),
                              "arcs with grooves between them, 360 deg in all at most");
      }
    }
    return fits;
  }

  Context& context_;
  const Value& value_;
  film::FilmModel& film_;
  FilmReader& reader_;
  std::vector<ArcAt> found_;
};

/// True if a feature lies within one of the arcs.
bool lies_within(const film::SurfaceFeature& feature, const film::Arcs& bore) {
  return std::any_of(bore.arcs.begin(), bore.arcs.end(), [&feature](const film::Arc& arc) {
    const double from_middle = std::abs(std::remainder(feature.phi - 0.5 * (arc.from + arc.to), two_pi));
    return from_middle + 0.5 * feature.arc <= 0.5 * (arc.to - arc.from) + same_angle;
  });
}

/// Where a groove and the side of the bearing meet at different pressures, the flow past the corner has no limit as the
/// grid is refined.
void warn_of_corners(Context& context, const Value& value, const film::FilmModel& film) {
  const auto is_step = [](const film::Edge& end, const film::Edge& side) {
    return end.kind == film::EdgeKind::pressure && side.kind == film::EdgeKind::pressure &&
           end.pressure != side.pressure;
  };
  for (const film::PatchEnds& ends : film.ends) {
    for (const film::Edge& end : {ends.first, ends.last}) {
      if (!is_step(end, film.edge_left) && !is_step(end, film.edge_right)) continue;
      const Value& at = *value.find(value.find("arcs") != nullptr ? "arcs" : "bore");
      context.model.warnings.push_back(
          {at.key_position, at.path,
           fmt::format("a groove at {:.4g} bar that is open to an edge of another pressure", 1e-5 * end.pressure),
           "the pressure of the edges in the grooves; or a whole bore whose grooves end before the edges: an "
           "`axial_groove` of `features`",
           "the flow past the corner, and its power, depend on the grid and grow as that is refined"});
      return;
    }
  }
}

}  // namespace

void read_arcs(Context& context, const Value& value, Bearing& bearing, FilmReader& reader) {
  ArcReader(context, value, bearing, reader).read();
}

void check_with_arcs(Context& context, const Value& value, const Bearing& bearing) {
  const film::FilmModel& film = bearing.film;
  if (film.ends.empty()) return;
  if (film.supply.kind != film::SupplyKind::none)
    context.fault_at_key(*value.find("supply"), "a supply line in a bore of arcs",
                         "oil in the grooves between them: `edge_pressure` and `ambient_fill` of the arcs");
  if (film.pressures == film::PressureScale::absolute)
    context.fault(*value.find("pressures"), "absolute pressures, which would count the atmosphere below an arc as load",
                  "gauge, with `cavitation: {pressure: -1.01325 bar}` for a vacuum");
  warn_of_corners(context, value, film);
  const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
  if (heat != nullptr && std::holds_alternative<film::BodyWall>(heat->shell))
    context.fault(*value.find("thermal"), "a shell in a body that conducts, around a bore of arcs",
                  "`insulated`, `given`, a `ring`, a `pad` or a `node` as the shell's wall");
  if (!context.has_fault_in(value.path) && !(film.c + film::gap_opening(film).minCoeff() > 0))
    context.fault_at_key(*value.find(value.find("arcs") != nullptr ? "arcs" : "bore"),
                         "arcs that close the gap beside their nearest point", "a preload nearer to 0");
  for (const auto& [name, feature] : section(value, "features")) {
    const auto found = std::find_if(film.features.begin(), film.features.end(),
                                    [&, &wanted = name](const auto& f) { return f.name == wanted; });
    if (found == film.features.end() || context.has_fault_in(feature.path)) continue;
    if (found->surface == film::Surface::journal || !lies_within(*found, *film::arcs_of(film)))
      context.fault_at_key(feature,
                           found->surface == film::Surface::journal ? "a feature of a journal in a bore of arcs"
                                                                    : "it does not lie within one arc",
                           "a feature of the shell within one of the arcs");
  }
}

}  // namespace hersey::model
