# SPDX-License-Identifier: GPL-3.0-or-later
# tunica_embed(TARGET NAME FILE) puts a text file into a library, as the function
#   namespace tunica::embedded { std::string_view NAME(); }
# Editing the file builds the library again. The file must not hold the text )tunica_text" .
#
# The same file, run as a script, writes the source: cmake -DNAME=... -DFILE=... -DOUTPUT=... -P

if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${FILE} text)
  file(WRITE ${OUTPUT}
"#include <string_view>

namespace tunica::embedded {

std::string_view ${NAME}();

std::string_view ${NAME}() {
  static constexpr char text[] = R\"tunica_text(")
  file(APPEND ${OUTPUT} "${text}")
  file(APPEND ${OUTPUT} ")tunica_text\";
  return {text, sizeof text - 1};
}

}  // namespace tunica::embedded
")
  return()
endif()

set(tunica_embed_script ${CMAKE_CURRENT_LIST_FILE})
function(tunica_embed target name file)
  cmake_path(ABSOLUTE_PATH file)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DFILE=${file} -DOUTPUT=${output} -P ${tunica_embed_script}
    DEPENDS ${file} ${tunica_embed_script} VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
