#pragma once

#include "check/vocabulary.h"
#include "hersey/model/model.h"

// Words of bodies, forces and simulations.
namespace hersey::model {

inline constexpr Vocabulary<fem::Connection, 2> connection_words{{
    {fem::Connection::rigid, "rigid", "the nodes follow the frame as one rigid piece"},
    {fem::Connection::average, "average",
     "the frame follows the nodes' mean motion, and what acts on it spreads over them; on one node or a line it "
     "rotates "
     "with the elements around"},
}};

/// Form of a body: true if every node moves.
inline constexpr Vocabulary<bool, 2> form_words{{
    {false, "modal", "it moves in static shapes of its frames and vibrations"},
    {true, "nodal", "every node moves; `modes` then only draw it in the report"},
}};

/// Treatment of parts of a mesh that are not connected.
inline constexpr Vocabulary<fem::Parts, 2> parts_words{{
    {fem::Parts::one, "one", "the mesh hangs together by shared nodes or ties; anything else is a mistake"},
    {fem::Parts::apart, "apart", "frames hold each part: a rigid one joins the parts it is attached to"},
}};

inline constexpr Vocabulary<mbd::Strain, 2> strain_words{{
    {mbd::Strain::small, "small", "displacements against the body's axes strain linearly"},
    {mbd::Strain::finite, "finite",
     "by Green and Lagrange: large bending, stiffening by pull; nodal bodies whose frames but the first are "
     "`connection: rigid`, and whose surfaces deform under no film or contact"},
}};

inline constexpr Vocabulary<Axes, 2> axes_of_frame_words{{
    {Axes::ground, "ground", "axes fixed in space"},
    {Axes::body, "body", "axes of the frame it acts at"},
}};

inline constexpr Vocabulary<Axes, 2> axes_of_body_words{{
    {Axes::ground, "ground", "axes fixed in space"},
    {Axes::body, "body", "axes of the body"},
}};

inline constexpr Vocabulary<Analysis, 5> analysis_words{{
    {Analysis::dynamics, "dynamics", "motion under forces, integrated over time"},
    {Analysis::kinematics, "kinematics", "motion that drives prescribe completely, and the forces it takes"},
    {Analysis::equilibrium, "static",
     "rest under gravity and the loads at `start`, drives locked; films at rest carry what their "
     "supplies press"},
    {Analysis::steady, "steady",
     "the steady motion in which drives keep the speed they have at the start and everything else keeps still in its "
     "coordinates: where shafts float in their bearings, all found at once"},
    {Analysis::modes, "modes", "natural frequencies, damping and stability of small motions"},
}};

inline constexpr Vocabulary<ModesAbout, 4> modes_about_words{{
    {ModesAbout::start, "start", "the state at the start"},
    {ModesAbout::equilibrium, "equilibrium", "the static equilibrium"},
    {ModesAbout::turning, "turning",
     "the steady motion in which drives keep the speed they have at the start and everything else keeps still in its "
     "coordinates, as by `analysis: steady`: rotating blades, shafts in their bearings"},
    {ModesAbout::end, "end",
     "the state at the end of a run over `duration`; bearings by their tangent there, over its last step"},
}};

/// Sign of a torque: true if positive.
inline constexpr Vocabulary<bool, 2> torque_sign_words{{
    {true, "positive", "it drives the first wheel about its z-axis: from x to y"},
    {false, "negative", "the other way round"},
}};

inline constexpr Vocabulary<LeadIn, 3> lead_in_words{{
    {LeadIn::none, "none", "the cycles of the run begin with the state at the start of the model"},
    {LeadIn::half_grids, "half_grids",
     "cycles with films on grids of half as many lines and rows are run until they repeat, and discarded; the cycles "
     "of the run begin with the motion, oil and temperatures that they end with, and are compared as without them"},
    {LeadIn::shooting, "shooting",
     "cycles on the grids of the run, each begun where those before predict that they repeat, are run until they do, "
     "and "
     "discarded; the cycles of the run go on from there: for motions that decay slowly, as of a shaft near the "
     "threshold of its whirl"},
}};

inline constexpr Vocabulary<Integrator, 2> integrator_words{{
    {Integrator::generalized_alpha, "generalized_alpha",
     "implicit, of second order, damps vibrations that the steps do not resolve: for every machine"},
    {Integrator::dormand_prince, "dormand_prince",
     "explicit Runge-Kutta method of order eight, for rigid bodies without films, contacts and piston rings: much "
     "faster at small tolerances; stiff springs and strong dampers limit its steps"},
}};

inline constexpr Vocabulary<InitialDeformation, 3> initial_deformation_words{{
    {InitialDeformation::none, "none", "undeformed: what presses on it makes it vibrate"},
    {InitialDeformation::internal, "internal",
     "as the forces of the start hold it between its frames; these stand as in the undeformed body, so that journals "
     "start where the joints put them"},
    {InitialDeformation::complete, "static",
     "as the forces of the start hold it; frames, and journals with them, are shifted by what the body gives way"},
}};

}  // namespace hersey::model
