#include "hersey/run/model_of_results.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/fem/skin.h"
#include "hersey/model/read.h"

namespace hersey::run {
namespace {

/// Overrides that stand before a model's text, as Model::resolved_text has them, and the text.
std::pair<std::vector<std::string>, std::string> overrides_and_text(const std::string& resolved) {
  const std::string mark = "# --set ";
  std::vector<std::string> overrides;
  std::size_t at = 0;
  while (resolved.compare(at, mark.size(), mark) == 0) {
    const std::size_t end = std::min(resolved.find('\n', at), resolved.size());
    overrides.push_back(resolved.substr(at + mark.size(), end - at - mark.size()));
    at = std::min(end + 1, resolved.size());
  }
  return {std::move(overrides), resolved.substr(at)};
}

}  // namespace

model::Model model_of_results(const results::Reader& results, const std::string& model_file) {
  const std::string stored = results.text_attribute("/", "model_file").value_or("");
  if (model_file.empty() && stored.empty())
    throw results::ReadError(results.path(), "it does not say where its model file lay; name it with --model FILE");
  const std::filesystem::path folder = std::filesystem::path(results.path()).parent_path();
  const std::string file = model_file.empty() ? (folder / stored).lexically_normal().string() : model_file;
  const auto [overrides, text] = overrides_and_text(results.text("/model"));
  return model::read_text(text, file, overrides);
}

void require_same_mesh(const results::Reader& results, const model::Model& model, const model::Body& body) {
  const std::string group = "/bodies/" + body.name;
  const auto refuse = [&](const std::string& found) {
    const std::string path = "bodies." + body.name + ".flexible.mesh";
    throw InputError(Fault{model.position_of(path), path, found, "the mesh with which the results were made",
                           "bring the old mesh back, or run the model again"});
  };
  const auto nodes = static_cast<double>(body.flexible->mesh->nodes.size());
  if (const auto before = results.number_attribute(group, "flexible_nodes"); before && *before != nodes)
    refuse(fmt::format("a mesh of {} nodes, where the results had {}", nodes, *before));
  const std::string corners = group + "/shapes/mesh/corners";
  if (body.flexible->mesh->elements.empty() || !results.has(corners)) return;
  const results::Array before = results.read(corners);
  const fem::Skin skin = fem::skin(*body.flexible->mesh);
  bool is_same = before.values.size() == 3 * skin.nodes.size();
  double size = 0, off = 0;
  for (std::size_t k = 0; is_same && k < skin.nodes.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = body.flexible->mesh->nodes[static_cast<std::size_t>(skin.nodes[k])][static_cast<int>(axis)];
      size = std::max(size, std::abs(x)), off = std::max(off, std::abs(x - before.values[3 * k + axis]));
    }
  constexpr double round_off_of_lengths = 1e-9;
  if (!is_same || off > round_off_of_lengths * size) refuse("a mesh of another shape than that of the results");
}

}  // namespace hersey::run
