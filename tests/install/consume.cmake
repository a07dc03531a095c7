# SPDX-License-Identifier: GPL-3.0-or-later
# Installs BUILD, moves the prefix, asks the program there for its scenes, and configures, builds and runs
# CONSUMER against it, all in WORK.

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/prefix)

# The package must not remember where it was built, nor where this machine keeps its libraries.
file(GLOB_RECURSE package_files ${WORK}/prefix/*/cmake/tunica/*.cmake)
foreach(file IN LISTS package_files)
  file(STRINGS ${file} lines)
  foreach(line IN LISTS lines)
    if(line MATCHES "${SOURCE}|${BUILD}|${WORK}|/usr/(lib|include)")
      message(FATAL_ERROR "${file} holds a path of this machine: ${line}")
    endif()
  endforeach()
endforeach()

execute_process(COMMAND ${WORK}/prefix/bin/tunica scene --list OUTPUT_VARIABLE scenes COMMAND_ERROR_IS_FATAL ANY)
if(NOT scenes MATCHES "${WORK}/prefix/share/tunica/scenes/cylinder.toml")
  message(FATAL_ERROR "The installed program lists other scenes than those beside it:\n${scenes}")
endif()

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${CONSUMER} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${WORK}/build/axisym_consumer)
