# SPDX-License-Identifier: GPL-3.0-or-later
# Finds KLU of SuiteSparse, whose Debian package brings no CMake files: the target
# SuiteSparse::klu. Installed with the package too, so that what links Tunica finds the library where it is
# on that machine.

find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse)
find_library(KLU_LIBRARY klu)
mark_as_advanced(KLU_INCLUDE_DIR KLU_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(KLU REQUIRED_VARS KLU_LIBRARY KLU_INCLUDE_DIR)

if(KLU_FOUND AND NOT TARGET SuiteSparse::klu)
  add_library(SuiteSparse::klu UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::klu PROPERTIES IMPORTED_LOCATION "${KLU_LIBRARY}"
                                                        INTERFACE_INCLUDE_DIRECTORIES "${KLU_INCLUDE_DIR}")
endif()
