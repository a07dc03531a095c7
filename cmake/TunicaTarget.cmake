# SPDX-License-Identifier: GPL-3.0-or-later
# What every library of the project shares: its alias tunica::NAME, warnings, include root (the
# repository's root here, include/tunica once installed) and its place in the install.

add_library(tunica_warnings INTERFACE)
target_compile_options(tunica_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                 -Wold-style-cast -Wcast-align -Woverloaded-virtual
                                                 -Wconversion -Wno-sign-conversion)
if(TUNICA_WARNINGS_AS_ERRORS)
  target_compile_options(tunica_warnings INTERFACE -Werror)
endif()
if(TUNICA_NATIVE)
  add_compile_options(-march=native)
endif()

# tunica_library(NAME SOURCES... ) makes tunica_NAME with the alias tunica::NAME.
function(tunica_library name)
  add_library(tunica_${name} STATIC ${ARGN})
  add_library(tunica::${name} ALIAS tunica_${name})
  set_target_properties(tunica_${name} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME tunica_${name}
                                                  POSITION_INDEPENDENT_CODE ON)
  target_compile_features(tunica_${name} PUBLIC cxx_std_20)
  target_include_directories(tunica_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/tunica>)
  target_link_libraries(tunica_${name} PRIVATE $<BUILD_INTERFACE:tunica_warnings>)
  install(TARGETS tunica_${name} EXPORT tunicaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tunica/${name}
          FILES_MATCHING PATTERN "*.hpp")
endfunction()
