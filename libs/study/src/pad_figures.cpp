#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "figure_table.h"
#include "hersey/film/temperature_law.h"

// Figures of pads that tilt, around a journal and below a collar.
namespace hersey::study {
namespace {

std::vector<std::string> numbers_of_pads(const Solution& s) {
  std::vector<std::string> numbers;
  for (const PadState& pad : s.pads->pads) numbers.push_back(pad.name);
  return numbers;
}

auto of_pad(double PadState::*member) {
  return [member](const Solution& s, std::size_t k) { return s.pads->pads[k].*member; };
}

Line of_pads(std::string_view key, const Unit& unit, double PadState::*member) {
  return {key, unit, of_pad(member), {.each = numbers_of_pads}};
}

/// Temperature of pads whose films have any.
Line of_warm_pads(std::string_view key, double PadState::*T) {
  return {key,
          kCelsius,
          [T = of_pad(T)](const Solution& s, std::size_t k) { return T(s, k) - film::zero_celsius; },
          {.only = [](const Solution& s) { return s.state.heat.has_value(); }, .each = numbers_of_pads}};
}

bool has_elastic_pads(const Solution& s) {
  return std::any_of(s.pads->pads.begin(), s.pads->pads.end(), [](const PadState& pad) { return pad.bending > 0; });
}

Line followed_at() {
  return {"pads_whirl_ratio", kNone, [](const Solution& s) { return s.pads->whirl_ratio; }};
}

}  // namespace

Group pad_figures() {
  return {"pads",
          {{"pad_force_<name>",
            kNewton,
            [](const Solution& s, std::size_t k) { return s.pads->pads[k].force.norm(); },
            {.each = numbers_of_pads}},
           of_pads("pad_tilt_<name>", kMicroradian, &PadState::tilt),
           of_pads("pad_pivot_travel_<name>", kMicrometre, &PadState::pivot_travel),
           of_pads("pad_h_pivot_<name>", kMicrometre, &PadState::h_pivot),
           {"pad_bending_<name>",
            kMicrometre,
            of_pad(&PadState::bending),
            {.only = has_elastic_pads, .each = numbers_of_pads}},
           of_warm_pads("pad_T_max_<name>", &PadState::T_max),
           of_warm_pads("pad_T_face_max_<name>", &PadState::T_face_max),
           followed_at()}};
}

Group pad_pivot_figures() {
  return {"pivots",
          {of_pads("pad_tilt_along_<name>", kMicroradian, &PadState::tilt),
           of_pads("pad_tilt_across_<name>", kMicroradian, &PadState::tilt_across),
           of_pads("pad_pivot_travel_<name>", kMicrometre, &PadState::pivot_travel),
           of_pads("pad_h_pivot_<name>", kMicrometre, &PadState::h_pivot),
           of_warm_pads("pad_T_max_<name>", &PadState::T_max),
           of_warm_pads("pad_T_face_max_<name>", &PadState::T_face_max), followed_at()}};
}

}  // namespace hersey::study
