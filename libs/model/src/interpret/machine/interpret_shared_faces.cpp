#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "interpret/context/interpret.h"

// Faces of nodal bodies that carry more than one film or contact: the static answers that each of them brings to the
// body would depend on each other, and nothing makes them independent there as the reduction of a modal body does.
namespace hersey::model {
namespace {

/// Who brings answers to loads on which faces of one body.
struct Bearer {
  std::string text;  ///< "bearing 'main'"
  const Value* at;
  const std::vector<fem::ElementFace>* faces;
};

const Value* value_of(const Context& context, const std::string& section_name, const std::string& name) {
  for (const Member& member : section(context.root, section_name))
    if (member.key == name) return &member.value;
  return nullptr;
}

void add_surface(Context& context, const Bearing& bearing, const std::string& side,
                 const std::optional<DeformingSurface>& surface, std::vector<Bearer>& bearers) {
  const Value* value = value_of(context, "bearings", bearing.name);
  if (!surface || value == nullptr) return;
  bearers.push_back({"bearing '" + bearing.name + "'", value->find(side + "_surface"), &surface->surface->faces});
}

std::vector<Bearer> bearers_on(Context& context, const Body& body) {
  std::vector<Bearer> bearers;
  for (const Contact& contact : context.model.contacts) {
    const DeformingFaces* faces = contact.second.body == body.name ? context.model.find_faces(contact.second) : nullptr;
    const Value* value = value_of(context, "contacts", contact.name);
    if (faces != nullptr && value != nullptr)
      bearers.push_back({"contact '" + contact.name + "'", value->find("between"), &faces->faces});
  }
  for (const Bearing& bearing : context.model.bearings) {
    if (bearing.shell.body == body.name) add_surface(context, bearing, "shell", bearing.shell_surface, bearers);
    if (bearing.journal.body == body.name) add_surface(context, bearing, "journal", bearing.journal_surface, bearers);
  }
  return bearers;
}

}  // namespace

void require_separate_faces(Context& context) {
  for (const Body& body : context.model.bodies) {
    if (!body.flexible || !body.flexible->nodal) continue;
    std::map<std::pair<int, int>, const Bearer*> bearer_of;
    const std::vector<Bearer> bearers = bearers_on(context, body);
    for (const Bearer& bearer : bearers) {
      const Bearer* other = nullptr;
      for (const fem::ElementFace face : *bearer.faces) {
        const auto [entry, is_new] = bearer_of.try_emplace({face.element, face.face}, &bearer);
        // Contacts on the very same faces share their answers.
        if (!is_new && entry->second->faces != bearer.faces) other = entry->second;
      }
      if (other == nullptr) continue;
      context.fault(
          *bearer.at,
          fmt::format("faces of the nodal body '{}' that carry {} and {}", body.name, other->text, bearer.text),
          "faces of a nodal body that carry one film or one shape that touches",
          "choose faces apart for the two, or give the body `form: modal`");
    }
  }
}

}  // namespace hersey::model
