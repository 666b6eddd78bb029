#include "schema/format.h"

namespace hersey::model {
namespace {

/// Names of variables, which the standard leaves free: `axle.speed`, `gain[2]`.
TypePtr by_variable(const std::string& title, const TypePtr& item) {
  auto type = std::make_shared<Type>(*named(title, item));
  type->free_names = true;
  return type;
}

}  // namespace

TypePtr fmus_format() {
  return named(
      "a mapping from names to FMUs",
      object("an FMU",
             {
                 required("file", text("a file", "controller.fmu"),
                          "FMU for co-simulation by FMI 2.0 or 3.0 with a library for 64-bit Linux, beside the model "
                          "file. Its library is loaded and runs within hersey: run only those whose source you trust."),
                 required("step", quantity("s", "1 ms", Range::positive()),
                          "Communication step: the time between two exchanges. Steps of the machine end at each."),
                 optional("inputs",
                          by_variable("a mapping from inputs of the FMU to what they are given", fmu_input_format()),
                          "What its inputs are given at each exchange: a joint coordinate or its rate as in "
                          "expressions, `main.rotation_rate`; a quantity of the [results](results-file.md) by its path "
                          "with dots, `bearings.main.h_min`, with a component `bodies.rod.position.x` or "
                          "`bodies.rod.amplitudes[1]`; or a function of time and joint coordinates.",
                          "its own start values"),
                 optional("parameters",
                          by_variable("a mapping from parameters of the FMU to values",
                                      scalar("a number, quantity, truth value or text", "2 N.m.s/rad")),
                          "Start values of its variables; a bare number is in the variable's own unit.",
                          "its own start values"),
             }));
}

}  // namespace hersey::model
