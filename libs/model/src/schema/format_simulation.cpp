#include "schema/format.h"
#include "schema/machine_vocabulary.h"

namespace hersey::model {

namespace {

TypePtr step_format() {
  const TypePtr fixed = quantity_in({"s", "rad"}, "0.1 ms", Range::positive());
  const TypePtr controlled = object(
      "an error control",
      {
          required("tolerance", number("1e-4", {.low = 1e-12, .high = 0.1}),
                   "Largest error of position that a step may add: angles in rad, lengths over the machine's size, "
                   "positions of journals over their clearance, deflections of gears' teeth over a hundredth of their "
                   "pitch."),
          defaulted("smallest", quantity("s", "1e-9 s", Range::positive()), "1e-9 s",
                    "A step that needs to be shorter ends the run."),
          optional("largest", fixed, "Longest step, or the crank's angle.", "a fiftieth of the run"),
      });
  return any_of("a time such as 0.1 ms, an angle of the crank, or {tolerance}", {fixed, controlled});
}

TypePtr cycle_format() {
  const TypePtr span = quantity_in({"s", "rad"}, "720 deg", Range::positive());
  const TypePtr found =
      object("a period to be found",
             {
                 required("about", span, "Where the search begins; a whole number of steps, which keep that number."),
             });
  return object(
      "a cycle",
      {
          required("period", any_of("a time or an angle > 0, such as 720 deg, or {about}", {span, found}),
                   "Time or crank angle of one cycle; a whole number of steps. With `{about}` it is found, with "
                   "`lead_in: shooting`: of machines that oscillate by themselves, such as rotors in oil whirl."),
          defaulted("until_converged", number("0.01", {.low = 0, .high = 1, .high_open = true}), "0.01",
                    "Ends the run once no bearing's smallest film thickness, peak pressure and mean friction loss "
                    "differs by more than this share from the cycle before; 0 runs all cycles."),
          defaulted("most", integer(20, {.low = 1, .high = 100000}), "20", "Cycles after which the run ends anyway."),
          defaulted("lead_in", choice(lead_in_words), "none",
                    "Cheaper cycles before those of the run, for machines whose cycles take long to repeat."),
          defaulted("multipliers", integer(0, {.low = 0, .high = 20}), "0",
                    "Floquet multipliers to find of the motion that repeats, with `lead_in: shooting`: the factors by "
                    "which small deviations change in a cycle; one above 1 is of a motion that no machine keeps. Each "
                    "costs up to four cycles."),
      });
}

TypePtr checkpoint_format() {
  return object("intervals of checkpoints",
                {
                    optional("every", quantity_in({"s", "rad"}, "0.1 s", Range::positive()),
                             "Simulated time or crank angle between two checkpoints.", "`wall_time` alone counts"),
                    defaulted("wall_time", quantity("s", "5 min", Range::positive()), "5 min",
                              "Computing time after which a checkpoint is written in any case."),
                });
}

}  // namespace

TypePtr simulation_format() {
  const TypePtr span = quantity_in({"s", "rad"}, "0.1 s", Range::positive());
  const Range fraction{.low = 0, .high = 1, .low_open = true, .high_open = true};
  const TypePtr settle = object(
      "a condition", {
                         defaulted("tolerance", number("1e-4", fraction), "1e-4",
                                   "Change of every bearing's eccentricity ratio below which it counts as settled."),
                         required("over", quantity_in({"s", "rad"}, "360 deg", Range::positive()),
                                  "Time or crank angle between the states compared."),
                     });
  const TypePtr analysis = choice(analysis_words), about = choice(modes_about_words);
  return object(
      "simulation settings",
      {
          defaulted("analysis", analysis, "dynamics", "What is computed."),
          optional("duration", span, "Time to simulate, or the crank's angle.",
                   "**required** unless there is a `cycle` or the analysis stays at the start"),
          optional(
              "step", step_format(),
              "Time step, or the crank's angle; or `{tolerance}`, and steps are chosen so that the estimated error "
              "of each stays below it. A step that fails is shortened.",
              "**required** unless the analysis stays at the start"),
          defaulted("modes_about", about, "start", "The state about which `modes` looks for small motions."),
          optional("crank", reference(Refers::joint, "main"),
                   "Revolute joint driven at a constant speed: converts angles to times, and is the report's abscissa.",
                   "angles cannot be used"),
          defaulted("start", quantity("s", "0 s"), "0 s", "Time at the start."),
          optional("initial_deformation", choice(initial_deformation_words),
                   "How bodies that deform start, in `dynamics`.",
                   "`internal` where a film presses on a surface that deforms or a body is `nodal`, otherwise `none`"),
          defaulted("integrator", choice(integrator_words), "generalized_alpha", "Method that integrates the motion."),
          defaulted(
              "spectral_radius", number("0.8", {.low = 0, .high = 1}), "0.8",
              "Damping of the fastest vibrations by generalized-alpha: 1 none (where drives or closed loops constrain "
              "motions with `step: {tolerance}` alone), 0 all within a step."),
          defaulted("tolerance", number("1e-8", fraction), "1e-8",
                    "Relative residual at which a step counts as solved."),
          defaulted("max_iterations", integer(50, {.low = 1, .high = 10000}), "50", "Newton iterations per step."),
          defaulted("smallest_step", quantity("s", "1e-9 s", Range::positive()), "1e-9 s",
                    "A step that still fails at this length ends the run."),
          optional(
              "cycle", cycle_format(),
              "Runs cycle by cycle until the bearings repeat themselves; `duration`, which may then be left out, can "
              "only end it earlier. Each cycle's figures are in the results and the report.",
              "runs to the end"),
          optional("checkpoint", checkpoint_format(),
                   "How often the run writes down how to go on: `hersey run --resume` continues after Ctrl-C, a crash "
                   "or a lost machine, to the same numbers.",
                   "`{wall_time: 5 min}`"),
          optional("settle", settle, "Ends the run once every bearing repeats itself.", "runs to the end"),
      });
}

TypePtr output_format() {
  return object(
      "output settings",
      {
          defaulted("every", integer(1, {.low = 1, .high = 1000000000}), "1", "Steps between rows of the time series."),
          optional("interval", quantity_in({"s", "rad"}, "1 ms", Range::positive()),
                   "Time or crank angle between rows of the time series, each hit exactly by a step. With an error "
                   "control only; `every` then does not count.",
                   "rows by steps"),
          optional("fields_every", quantity_in({"s", "rad"}, "5 deg", Range::positive()),
                   "Time or crank angle between stored pressure and film-thickness fields.", "a hundredth of the run"),
          optional(
              "meshes_at",
              list("times or crank angles, counted from the start",
                   quantity_in({"s", "rad"}, "360 deg", Range::not_negative())),
              "When to write the deformed meshes of all flexible bodies, with stress and film pressure, beside the "
              "results file, for ParaView; angles in every cycle where the model has cycles. At the first step "
              "there or beyond; steps of controlled error end there.",
              "not written"),
      });
}

}  // namespace hersey::model
