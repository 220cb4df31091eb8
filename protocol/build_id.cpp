#include "protocol/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <span>
#include <string_view>

namespace sluice::protocol {
namespace {

constexpr std::size_t align4(std::size_t size) {
  return (size + 3) / 4 * 4;
}

// The description of the build id among notes: each is a head, its name and its description, padded to words.
std::span<const unsigned char> find_build_id(std::span<const unsigned char> notes) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof head);
    const std::size_t name = sizeof head, description = name + align4(head.n_namesz);
    if (description + head.n_descsz > notes.size()) break;
    const std::string_view owner(reinterpret_cast<const char*>(notes.data()) + name, head.n_namesz);
    if (head.n_type == NT_GNU_BUILD_ID && owner == std::string_view("GNU\0", 4))
      return notes.subspan(description, head.n_descsz);
    notes = notes.subspan(std::min(notes.size(), description + align4(head.n_descsz)));
  }
  return {};
}

// The program itself comes first of all loaded objects; the others are not looked at.
int read_program(dl_phdr_info* info, std::size_t /*size*/, void* text) {
  for (int s = 0; s < info->dlpi_phnum; ++s) {
    const ElfW(Phdr)& segment = info->dlpi_phdr[s];
    if (segment.p_type != PT_NOTE) continue;
    const auto* begin = reinterpret_cast<const unsigned char*>(info->dlpi_addr + segment.p_vaddr);
    const auto id = find_build_id({begin, segment.p_memsz});
    if (!id.empty()) *static_cast<std::string*>(text) = fmt::format("{:02x}", fmt::join(id, ""));
  }
  return 1;
}

}  // namespace

std::string build_id() {
  std::string text;
  dl_iterate_phdr(read_program, &text);
  return text;
}

}  // namespace sluice::protocol
