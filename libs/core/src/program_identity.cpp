#include "hersey/core/program_identity.h"

#include <fmt/format.h>
#include <link.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>

// Version and kernels of OpenBLAS; null with other libraries.
extern "C" __attribute__((weak)) const char* openblas_get_config();

namespace hersey {
namespace {

std::uintptr_t aligned(std::uintptr_t size) { return (size + 3) & ~std::uintptr_t{3}; }

// The build ID among the notes of a segment, in hexadecimal digits.
std::string build_id_in(const char* notes, std::size_t size) {
  std::string id;
  const char* const end = notes + size;
  while (notes + sizeof(ElfW(Nhdr)) <= end) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes, sizeof note);
    const char* const owner = notes + sizeof note;
    const char* const content = owner + aligned(note.n_namesz);
    if (content + note.n_descsz > end) return {};
    if (note.n_type == NT_GNU_BUILD_ID && std::string_view(owner, note.n_namesz) == std::string_view("GNU\0", 4)) {
      for (std::size_t i = 0; i < note.n_descsz; ++i)
        fmt::format_to(std::back_inserter(id), "{:02x}", static_cast<unsigned char>(content[i]));
      return id;
    }
    notes = content + aligned(note.n_descsz);
  }
  return {};
}

bool contains(const dl_phdr_info& object, std::uintptr_t address) {
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object.dlpi_phdr[i];
    const std::uintptr_t begin = object.dlpi_addr + segment.p_vaddr;
    if (segment.p_type == PT_LOAD && address >= begin && address < begin + segment.p_memsz) return true;
  }
  return false;
}

// Called for each loaded object until it returns other than 0.
int take_build_id(dl_phdr_info* object, std::size_t, void* id) {
  if (!contains(*object, reinterpret_cast<std::uintptr_t>(&program_identity))) return 0;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    // The loader gives addresses as numbers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* notes = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
    std::string found = build_id_in(notes, segment.p_memsz);
    if (!found.empty()) *static_cast<std::string*>(id) = std::move(found);
  }
  return 1;
}

}  // namespace

std::string program_identity() {
  std::string id;
  dl_iterate_phdr(take_build_id, &id);
  if (!id.empty() && openblas_get_config != nullptr) id += fmt::format(" {}", openblas_get_config());
  return id;
}

}  // namespace hersey
