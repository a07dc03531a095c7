# SPDX-License-Identifier: GPL-3.0-or-later
# What an install holds beside the libraries and headers (see TunicaTarget.cmake): the program, the
# scenes, and the files that find_package(tunica) reads.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tunica)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tunicaConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/tunicaConfig.cmake INSTALL_DESTINATION ${package_folder})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tunicaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tunicaConfig.cmake ${PROJECT_BINARY_DIR}/tunicaConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindUDUNITS2.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindKLU.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindPETSc.cmake
        DESTINATION ${package_folder})
install(EXPORT tunicaTargets NAMESPACE tunica:: DESTINATION ${package_folder})

install(TARGETS tunica RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TUNICA_FULL3D)
  install(TARGETS tunica-full3d RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/tunica)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/sweep-array.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/tunica)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The program holds uPlot and three.js, for its reports.
install(FILES ${PROJECT_SOURCE_DIR}/third_party/uplot/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}/uplot)
install(FILES ${PROJECT_SOURCE_DIR}/third_party/three/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}/three)
