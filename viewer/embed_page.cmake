# cmake -DPAGE=folder -DSOURCE=file.cpp -P embed_page.cmake: all files of the folder as one table, viewer/page.hpp.
# The assembler takes them in as they are, so that megabytes of them compile at once.
file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${PAGE} ${PAGE}/*)
list(SORT files)
set(labels "")
set(names "")
set(rows "")
set(number 0)
foreach(file IN LISTS files)
  string(APPEND labels "    \"page_${number}: .incbin \\\"${PAGE}/${file}\\\"\\n\"\n")
  string(APPEND names "extern const char page_${number}[], page_${number}_end[];\n")
  string(APPEND labels "    \"page_${number}_end: .byte 0\\n\"\n")
  string(APPEND rows "      {\"/${file}\", {page_${number}, std::size_t(page_${number}_end - page_${number})}},\n")
  math(EXPR number "${number} + 1")
endforeach()
if(number EQUAL 0)
  message(FATAL_ERROR "${PAGE} has no files: is the page built?")
endif()
file(WRITE ${SOURCE} "// Made by viewer/embed_page.cmake.
#include <array>

#include \"viewer/page.hpp\"

__asm__(
    \".section .rodata\\n\"
${labels}    \".text\\n\");

extern \"C\" {
${names}}

namespace cleancolor {

std::span<const PageFile> page_files() {
  static const std::array<PageFile, ${number}> files = {{
${rows}  }};
  return files;
}

}  // namespace cleancolor
")
