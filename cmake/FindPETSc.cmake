# SPDX-License-Identifier: GPL-3.0-or-later
# Finds PETSc (real numbers), which brings a pkg-config file: the target PETSc::petsc. Installed with the
# package too, so that what links Tunica finds the library where it is on that machine.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PETSC_CONFIG QUIET PETSc)
endif()
find_path(PETSC_INCLUDE_DIR petsc.h HINTS ${PETSC_CONFIG_INCLUDE_DIRS})
find_library(PETSC_LIBRARY NAMES ${PETSC_CONFIG_LIBRARIES} petsc_real petsc HINTS ${PETSC_CONFIG_LIBRARY_DIRS})
mark_as_advanced(PETSC_INCLUDE_DIR PETSC_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PETSc REQUIRED_VARS PETSC_LIBRARY PETSC_INCLUDE_DIR
                                        VERSION_VAR PETSC_CONFIG_VERSION)

if(PETSC_FOUND AND NOT TARGET PETSc::petsc)
  add_library(PETSc::petsc UNKNOWN IMPORTED)
  set_target_properties(PETSc::petsc PROPERTIES IMPORTED_LOCATION "${PETSC_LIBRARY}"
                                                INTERFACE_INCLUDE_DIRECTORIES "${PETSC_INCLUDE_DIR}")
endif()
