#pragma once

#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// A film of piezoviscous oil on a coarse grid between rough surfaces.
inline film::FilmModel rough_film() {
  film::FilmModel model;
  model.c = 34e-6;
  model.grid = {.n_phi = 30, .n_z = 5};
  model.lubricant.viscosity_law = film::Barus{1.28e-10};
  model.supply = {.kind = film::SupplyKind::widest_gap, .phi = 0, .pressure = 2e5};
  model.asperities = {.model = film::AsperityModel::greenwood_tripp_fit,
                      .sigma = 3e-6,
                      .elastic_factor = 3e-3,
                      .composite_modulus = 57e9,
                      .mu_friction = 0.1};
  return model;
}

}  // namespace hersey::bearing
