#include "hersey/model/read.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "check/check.h"
#include "hersey/core/input_file.h"
#include "hersey/model/convert.h"
#include "interpret/context/interpret.h"
#include "interpret/context/interpret_size.h"
#include "interpret/read/fault_causes.h"
#include "interpret/read/reader.h"
#include "interpret/read/templates.h"
#include "schema/format.h"
#include "tree/substitution.h"

namespace hersey::model {
namespace {

constexpr std::uintmax_t kLargestModelFile = std::uintmax_t{1} << 26;  // 67 MB: tables of numbers belong into files

std::vector<Parameter> parameters_of(const Node& root) {
  std::vector<Parameter> parameters;
  const Node* section = root.find("parameters");
  if (section == nullptr) return parameters;
  for (const Entry& entry : section->entries) {
    parameters.push_back({entry.key, written(entry.value), entry.value.position});
  }
  return parameters;
}

std::string resolved(const std::string& text, const std::vector<std::string>& overrides) {
  std::string header;
  for (const std::string& change : overrides) {
    header += "# --set ";
    for (const char c : change) header += c == '\n' ? ' ' : c;
    header += '\n';
  }
  return header + text;
}

bool stands_before(const Fault& a, const Fault& b) {
  const auto key = [](const Fault& fault) {
    return std::tie(fault.position.file, fault.position.line, fault.position.column);
  };
  return key(a) < key(b);
}

}  // namespace

std::string file_text(const std::string& path) {
  InputFile file = read_input_file(path, kLargestModelFile);
  if (!file.fault.empty()) throw InputError(Fault{{path, 0, 0}, "", file.fault, "a model file", ""});
  if (file.content.starts_with("\x89HDF"))
    throw InputError(Fault{{path, 0, 0},
                           "",
                           "the results of a run, or another HDF5 file",
                           "a model file; results are for `hersey report`, and `hersey export` with `--loads`, "
                           "`--films` or `--netcdf`",
                           ""});
  return std::move(file.content);
}

std::vector<std::string> top_level_keys() {
  std::vector<std::string> keys;
  for (const Key* key : all_keys(model_format())) keys.push_back(key->name);
  return keys;
}

CompleteTree complete_tree(Node& root, const std::vector<Override>& overrides, std::vector<Fault>& faults) {
  const OrderedOverrides ordered = in_order(root, overrides, faults);
  apply_overrides(root, ordered.before_templates, top_level_keys(), faults);
  Substitution substitution(faults);
  Scope parameters;
  define_parameters(root, substitution, parameters);
  Templates templates(root, parameters, substitution, faults);
  templates.expand(root);
  apply_overrides(root, ordered.after_templates, top_level_keys(), faults);
  templates.expand(root);  // of what overrides use
  std::erase_if(root.entries, [](const Entry& entry) { return entry.key == "templates"; });
  substitute_parameters(root, substitution, parameters);
  Composites composites = expand_composites(root, faults);
  return {templates.unused(), templates.uses(), std::move(composites)};
}

namespace {

/// Bearings of several films as one bearing each, with the model of it by itself.
void interpret_composites(Context& context, const Composites& composites) {
  context.model.positions.insert(composites.positions.begin(), composites.positions.end());
  for (const CompositeParts& parts : composites.parts) {
    Composite composite{.kind = parts.kind,
                        .pads = parts.pads,
                        .pivot_angles = parts.pivot_angles,
                        .pivot_radius = parts.pivot_radius,
                        .whirl_ratio = parts.whirl_ratio};
    auto alone = std::make_shared<Model>(read_tree(parts.alone, context.model.file, {}, composite.alone_faults));
    const auto first = std::find_if(context.model.bearings.begin(), context.model.bearings.end(),
                                    [&](const Bearing& bearing) { return bearing.name == parts.pads.front(); });
    if (!parts.is_in_machine) {
      context.faults.insert(context.faults.end(), composite.alone_faults.begin(), composite.alone_faults.end());
      context.model.warnings.insert(context.model.warnings.end(), alone->warnings.begin(), alone->warnings.end());
    }
    if (composite.alone_faults.empty() && !alone->bearings.empty()) {
      composite.bearing = alone->bearings.front();
      composite.alone = std::move(alone);
    } else if (first != context.model.bearings.end()) {
      composite.bearing = *first;
    } else {
      continue;
    }
    name_composites({parts}, composite.alone_faults);
    tidy(composite.alone_faults);  // each pad has the same
    composite.bearing.name = parts.name;
    composite.bearing.position = parts.position;
    if (parts.point) composite.bearing.operating_point = *parts.point;
    context.model.composites.push_back(std::move(composite));
  }
}

}  // namespace

Model read_tree(Node root, const std::string& file, const std::vector<Override>& overrides,
                std::vector<Fault>& faults) {
  Model model;
  model.file = file;
  if (root.kind == Node::Kind::null) {
    faults.push_back({{file, 1, 1}, "", "an empty file", "a model, beginning with 'hersey: 1'", ""});
    return model;
  }
  const CompleteTree complete = complete_tree(root, overrides, faults);
  model.warnings = complete.warnings;
  model.parameters = parameters_of(root);
  const Value value = check(root, model_format(), faults, model.positions);
  Context context{value, model, faults};
  model.title = text_of(value, "title");
  model.description = text_of(value, "description");
  model.gravity = vector_of(value, "gravity");
  check_completeness(context);
  interpret_bodies(context);
  interpret_joints(context);
  interpret_fmus(context);
  interpret_drives(context);
  interpret_couplings(context);
  interpret_forces(context);
  interpret_contacts(context);
  interpret_lubricants(context);
  interpret_thermal_network(context);
  interpret_circuit(context);
  interpret_bearings(context);
  find_passing_holes(context);
  check_circuit(context);
  interpret_grooves(context);
  check_thermal_network(context);
  require_separate_faces(context);
  interpret_simulation(context);
  check_fmus(context);
  interpret_thermal_walls(context);
  check_functions_of_crank(context);
  interpret_study(context);
  check_table_ranges(context);
  check_size(context);
  interpret_composites(context, complete.composites);
  name_composites(complete.composites.parts, faults);
  name_composites(complete.composites.parts, model.warnings);
  name_template_uses(complete.uses, faults);
  return model;
}

void tidy(std::vector<Fault>& faults) {
  std::stable_sort(faults.begin(), faults.end(), stands_before);
  const auto same = [](const Fault& a, const Fault& b) { return a.text() == b.text(); };
  faults.erase(std::unique(faults.begin(), faults.end(), same), faults.end());
}

namespace {

/// To the faults of what an earlier version wrote in another way.
void suggest_conversion(const std::string& text, const std::string& file, std::vector<Fault>& faults) {
  for (const Change& change : converted(text, file).changes) {
    for (Fault& fault : faults) {
      if (fault.position.line != change.position.line || fault.position.column != change.position.column) continue;
      fault.expected += "; `hersey convert` brings this file up to date";
    }
  }
}

}  // namespace

struct ModelFile::Content {
  std::string text, file;
  std::vector<Fault> faults;  // of YAML
  std::optional<Node> root;
};

ModelFile::ModelFile(const std::string& path) : ModelFile(file_text(path), path) {}

ModelFile::ModelFile(std::string text, std::string file) {
  auto content = std::make_shared<Content>();
  content->text = std::move(text);
  content->file = std::move(file);
  content->root = parse_yaml(content->text, content->file, content->faults);
  content_ = std::move(content);
}

std::optional<TextMap> ModelFile::map() const {
  if (!content_->root) return std::nullopt;
  return TextMap(content_->text, content_->file, *content_->root);
}

const std::string& ModelFile::text() const { return content_->text; }

const std::string& ModelFile::file() const { return content_->file; }

Model ModelFile::read(const std::vector<std::string>& overrides) const {
  std::vector<Fault> faults;
  const std::vector<Override> changes = parse_overrides(overrides, faults);
  faults.insert(faults.end(), content_->faults.begin(), content_->faults.end());
  Model model;
  if (content_->root) model = read_tree(*content_->root, content_->file, changes, faults);
  if (!faults.empty()) {
    tidy(faults);
    if (content_->root) {
      faults = without_consequences(std::move(faults), *content_->root, [&](const Node& meant) {
        std::vector<Fault> others;
        (void)read_tree(meant, content_->file, changes, others);
        tidy(others);
        return others;
      });
      lead_to_parameters(content_->text, *content_->root, faults);
      tidy(faults);
    }
    if (content_->root) suggest_conversion(content_->text, content_->file, faults);
    throw InputError(std::move(faults));
  }
  model.resolved_text = resolved(content_->text, overrides);
  return model;
}

Model read_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides) {
  return ModelFile(text, file).read(overrides);
}

Model read(const std::string& path, const std::vector<std::string>& overrides) {
  return ModelFile(path).read(overrides);
}

SourcePosition Model::position_of(const std::string& path) const {
  for (std::string key = path; !key.empty(); key.resize(key.find_last_of('.'))) {
    const auto found = positions.find(key);
    if (found != positions.end()) return found->second;
    if (key.find('.') == std::string::npos) break;
  }
  return {file, 0, 0};
}

}  // namespace hersey::model
