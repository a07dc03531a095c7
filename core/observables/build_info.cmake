# SPDX-License-Identifier: GPL-3.0-or-later
# Run at every build as a script: cmake -DSOURCE=... -DTEMPLATE=... -DOUTPUT=... -DPROGRAM_VERSION=... -P
# configure_file leaves the output alone when nothing changed, so nothing is compiled again then.
set(PROGRAM_COMMIT "")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} describe --always --dirty --abbrev=40 --exclude=*
                  WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE PROGRAM_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
