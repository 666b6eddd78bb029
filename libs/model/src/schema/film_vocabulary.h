#pragma once

#include <optional>

#include "check/vocabulary.h"
#include "hersey/film/film_model.h"
#include "hersey/model/model.h"
#include "hersey/solver/fixed_point_iteration.h"

// Words of bearings and their oil.
namespace hersey::model {

inline constexpr Vocabulary<film::Cavitation, 4> cavitation_words{{
    {film::Cavitation::mass_conserving, "mass_conserving",
     "pressure or fill fraction at every point (Jakobsson, Floberg, Olsson)"},
    {film::Cavitation::reynolds, "reynolds",
     "zero pressure gradient at rupture; oil is lost where the film forms again"},
    {film::Cavitation::guembel, "guembel", "full film, negative pressures left out of the forces (half Sommerfeld)"},
    {film::Cavitation::full_film, "full_film",
     "no cavitation: negative pressures act on the surfaces (full Sommerfeld); for dampers and films under high "
     "pressure that do not cavitate"},
}};

inline constexpr Vocabulary<ThermalWalls, 3> thermal_walls_words{{
    {ThermalWalls::transient, "transient", "their temperatures follow from their heat capacities"},
    {ThermalWalls::cycle_mean, "cycle_mean",
     "they keep their temperatures over a cycle of the machine, and then take those at which its mean heat would pass "
     "them by: in a few cycles they are those of an engine that has run for long"},
    {ThermalWalls::frozen, "frozen", "they keep the temperatures they begin with"},
}};

inline constexpr Vocabulary<film::AsperityModel, 3> asperity_words{{
    {film::AsperityModel::none, "none", "smooth surfaces"},
    {film::AsperityModel::greenwood_tripp_fit, "greenwood_tripp_fit",
     "Greenwood and Tripp (1971), F = 4.4086e-5 (4 - (h - delta)/sigma)^6.804"},
    {film::AsperityModel::greenwood_tripp_exact, "greenwood_tripp", "the same with the exact integral F_5/2"},
}};

inline constexpr Vocabulary<OilInertia, 3> oil_inertia_words{{
    {OilInertia::none, "none", "the oil has no inertia"},
    {OilInertia::added_mass, "added_mass",
     "added mass of a parabolic velocity profile (6/5 of the mean flow's momentum), as at squeeze Reynolds numbers rho "
     "omega c^2/mu of up to about 10"},
    {OilInertia::added_mass_high_frequency, "added_mass_high_frequency",
     "added mass of a uniform velocity profile, as at squeeze Reynolds numbers far above 10"},
}};

inline constexpr Vocabulary<film::FlowFactors, 2> flow_factor_words{{
    {film::FlowFactors::patir_cheng, "patir_cheng",
     "it changes flow and shear of the oil (Patir and Cheng 1978, 1979)"},
    {film::FlowFactors::none, "none", "it matters to contact only"},
}};

inline constexpr Vocabulary<film::CavitatedShear, 2> cavitated_shear_words{{
    {film::CavitatedShear::film_share, "film_share", "the liquid's share of the gap"},
    {film::CavitatedShear::full, "full", "as if the gap were full"},
}};

inline constexpr Vocabulary<film::ShearForce, 3> shear_force_words{{
    {film::ShearForce::full, "full", "torque and net force"},
    {film::ShearForce::torque_only, "torque_only", "the net force of shear is left out"},
    {film::ShearForce::none, "none",
     "neither acts on the bodies, as in most charts of tilting pads; friction is reported nevertheless"},
}};

inline constexpr Vocabulary<film::TurbulenceModel, 4> turbulence_words{{
    {film::TurbulenceModel::none, "none", "a laminar film at every speed"},
    {film::TurbulenceModel::ng_pan, "ng_pan",
     "Reichardt's eddy viscosity integrated across the film (Ng and Pan 1965): the most exact"},
    {film::TurbulenceModel::constantinescu, "constantinescu",
     "powers of the Reynolds number from a mixing length (Constantinescu 1959)"},
    {film::TurbulenceModel::hirs, "hirs", "bulk flow with Blasius' friction of smooth walls (Hirs 1973)"},
}};

inline constexpr Vocabulary<film::TransitionNumber, 2> transition_words{{
    {film::TransitionNumber::reynolds, "reynolds", "Re = rho v h/mu of the sliding"},
    {film::TransitionNumber::taylor, "taylor", "Re sqrt(h/R), of the vortices between a journal and its bore"},
}};

/// No solver: it is chosen by film::usual_solver().
inline constexpr Vocabulary<std::optional<film::FilmSolver>, 4> film_solver_words{{
    {std::nullopt, "auto", "`multigrid` on grids of more than 15,000 nodes, `newton` on others: the faster of both"},
    {film::FilmSolver::newton, "newton", "Newton's method with exact derivatives"},
    {film::FilmSolver::multigrid, "multigrid", "the same, its linear systems solved by multigrid: for fine grids"},
    {film::FilmSolver::sor, "sor", "successive over-relaxation, for comparison"},
}};

inline constexpr Vocabulary<film::PressureScale, 2> pressure_scale_words{{
    {film::PressureScale::gauge, "gauge", "0 is the atmosphere, -1.01325 bar is a vacuum"},
    {film::PressureScale::absolute, "absolute", "0 is a vacuum"},
}};

inline constexpr Vocabulary<film::Surface, 2> feature_surface_words{{
    {film::Surface::shell, "shell", "the bore"},
    {film::Surface::journal, "journal", "the journal: it moves as the journal rotates"},
}};

inline constexpr Vocabulary<film::Surface, 2> profile_surface_words{{
    {film::Surface::shell, "shell", "the bore"},
    {film::Surface::journal, "journal", "the journal: it rotates with it"},
}};

inline constexpr Vocabulary<bearing::WearAround, 2> wear_around_words{{
    {bearing::WearAround::even, "even",
     "evenly: it turns often under loads that do not turn with it, and all of it passes the contact"},
    {bearing::WearAround::local, "local",
     "place by place in its own axes: crank pins, whose load comes at the same angles of the crank, and journals that "
     "swing"},
}};

inline constexpr Vocabulary<solver::Acceleration, 3> acceleration_words{{
    {solver::Acceleration::quasi_newton, "quasi_newton",
     "the interface's Jacobian is learnt from the steps taken (IQN-ILS)"},
    {solver::Acceleration::aitken, "aitken", "the share taken follows the last two corrections"},
    {solver::Acceleration::constant, "constant", "the same share of every correction"},
}};

}  // namespace hersey::model
