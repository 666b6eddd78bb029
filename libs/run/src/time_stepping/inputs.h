#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/settable_function.h"
#include "hersey/model/model.h"
#include "hersey/run/port_info.h"
#include "time_stepping/jump.h"

namespace hersey::run {

/// The functions of a model that can be set from outside; not those that outputs of FMUs set.
class Inputs {
 public:
  /// Replaces every input of `model` by a settable function. To be called before the model is built.
  explicit Inputs(model::Model& model);

  struct Input {
    InputInfo info;
    std::shared_ptr<SettableFunction> function;
    std::vector<model::Variable> variables;
    Jump jump = Jump::none;
    std::string refusal;  ///< why it cannot be set; empty where it can
  };

  [[nodiscard]] const std::vector<InputInfo>& infos() const { return infos_; }
  /// @throws std::invalid_argument if there is none
  [[nodiscard]] Input& find(const std::string& name);
  [[nodiscard]] static double value_of(const Input& input, const model::Simulation& plan, double t);

  void persist(Archive& archive);

 private:
  void add(model::Function& function, const std::string& unit, const std::string& text, Jump jump);

  model::Simulation plan_;
  std::vector<Input> inputs_;
  std::vector<InputInfo> infos_;
};

}  // namespace hersey::run
