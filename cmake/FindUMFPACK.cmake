# SPDX-License-Identifier: GPL-3.0-or-later
# Finds UMFPACK of SuiteSparse, whose Debian package brings no CMake files: the target
# SuiteSparse::umfpack. Installed with the package too, so that what links Tunica finds the library where it is
# on that machine.

find_path(UMFPACK_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse)
find_library(UMFPACK_LIBRARY umfpack)
mark_as_advanced(UMFPACK_INCLUDE_DIR UMFPACK_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(UMFPACK REQUIRED_VARS UMFPACK_LIBRARY UMFPACK_INCLUDE_DIR)

if(UMFPACK_FOUND AND NOT TARGET SuiteSparse::umfpack)
  add_library(SuiteSparse::umfpack UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::umfpack PROPERTIES IMPORTED_LOCATION "${UMFPACK_LIBRARY}"
                                                        INTERFACE_INCLUDE_DIRECTORIES "${UMFPACK_INCLUDE_DIR}")
endif()
