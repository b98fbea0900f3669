#include "samara/export/page_bytes.hpp"

#ifdef SAMARA_PAGE_FILE

// The page is some 700 kB: the assembler copies the file, where a compiler would parse every byte.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    ".hidden samara_page_begin\n"
    ".global samara_page_begin\n"
    "samara_page_begin:\n"
    ".incbin \"" SAMARA_PAGE_FILE
    "\"\n"
    ".hidden samara_page_end\n"
    ".global samara_page_end\n"
    "samara_page_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char samara_page_begin[];
extern const char samara_page_end[];
}

#endif

namespace samara {

std::string_view page_bytes() {
#ifdef SAMARA_PAGE_FILE
    return {samara_page_begin, static_cast<std::string_view::size_type>(samara_page_end - samara_page_begin)};
#else
    return {};
#endif
}

}  // namespace samara
