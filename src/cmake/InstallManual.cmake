# Run by `cmake --install`, with the variables that Install.cmake sets: has the program write its
# manual pages and completions, and installs them and the changelog.

# lantern_writes(ARGUMENTS... [TO FILE]): runs the program.
function(lantern_writes)
  cmake_parse_arguments(ARG "" "TO" "" ${ARGN})
  set(output "")
  if(ARG_TO)
    set(output OUTPUT_FILE ${ARG_TO})
  endif()
  execute_process(COMMAND ${lantern} ${ARG_UNPARSED_ARGUMENTS} ${output} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${lantern} could not write its manual (${result}); it must be built, and "
      "run on this machine")
  endif()
endfunction()

# Without the time of day in them, so that the same program gives the same package.
function(lantern_gzip)
  if(gzip)
    execute_process(COMMAND ${gzip} -9nf ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endfunction()

string(RANDOM LENGTH 12 own)  # somebody else may be installing from here, too
string(APPEND work -${own})
file(MAKE_DIRECTORY ${work}/man1)
lantern_writes(man --dir ${work}/man1)
file(GLOB pages ${work}/man1/*.1)
configure_file(${changelog} ${work}/changelog COPYONLY)
lantern_gzip(${pages} ${work}/changelog)
file(GLOB pages ${work}/man1/*)
file(GLOB changelog ${work}/changelog*)
lantern_writes(completions bash TO ${work}/lantern)
lantern_writes(completions zsh TO ${work}/_lantern)
lantern_writes(completions fish TO ${work}/lantern.fish)

set(data ${CMAKE_INSTALL_PREFIX}/${data_dir})
set(zsh_dir ${data}/zsh/site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(zsh_dir ${data}/zsh/vendor-completions)  # Debian's zsh looks here for those of packages
endif()
file(INSTALL ${pages} DESTINATION ${CMAKE_INSTALL_PREFIX}/${man_dir}/man1)
file(INSTALL ${changelog} DESTINATION ${data}/doc/lantern)
file(INSTALL ${work}/lantern DESTINATION ${data}/bash-completion/completions)
file(INSTALL ${work}/_lantern DESTINATION ${zsh_dir})
file(INSTALL ${work}/lantern.fish DESTINATION ${data}/fish/vendor_completions.d)
file(REMOVE_RECURSE ${work})
