# Run by `cmake --install`, with the variables that Install.cmake sets: pages as whoever has the
# packages reads them. Those below ${pages} lie as those of the repository do below ${source}/${part};
# scenarios/ is beside them. The program is on the path, headers are in lantern/, and what is not
# installed is no link.
cmake_policy(VERSION 3.20)

file(GLOB_RECURSE all "${pages}/*.md")
foreach(page ${all})
  cmake_path(RELATIVE_PATH page BASE_DIRECTORY "${pages}" OUTPUT_VARIABLE name)
  file(READ "${page}" text)

  # What one does first stands between two comments, in place of what one does with the sources.
  string(FIND "${text}" "<!-- from the sources -->" begin)
  string(FIND "${text}" "<!-- installed -->" end)
  if(begin GREATER_EQUAL 0 AND end GREATER begin)
    string(SUBSTRING "${text}" 0 ${begin} before)
    string(SUBSTRING "${text}" ${end} -1 behind)
    string(REPLACE "<!-- installed -->" "```sh
lantern list
lantern render ghost_quadtree
```

The pictures are in `output/ghost_quadtree/`. `man lantern` tells all commands and options." behind "${behind}")
    string(CONCAT text "${before}" "${behind}")
  endif()
  string(REGEX REPLACE "build/lantern([^_.a-z])" "lantern\\1" text "${text}")
  string(REGEX REPLACE "\n\\./run [a-z]+" "" text "${text}")
  string(REPLACE "\n```sh\n```\n" "" text "${text}")
  if(NOT name MATCHES "^src/")
    string(REGEX REPLACE "src/((${rooms})/[a-z_/]+[.]hpp)" "lantern/\\1" text "${text}")
  endif()

  string(REGEX MATCHALL "\\([^() \n]+\\)" targets "${text}")
  list(REMOVE_DUPLICATES targets)
  foreach(target ${targets})
    string(REGEX REPLACE "^.(.*).$" "\\1" target "${target}")
    string(FIND "${text}" "](${target})" at)
    if(at LESS 0 OR target MATCHES "^#|^[a-z]+:")
      continue()
    endif()
    string(REGEX REPLACE "#.*" "" file "${target}")
    cmake_path(GET name PARENT_PATH folder)
    cmake_path(SET file NORMALIZE "${part}/${folder}/${file}")
    string(REGEX REPLACE "^/+" "" file "${file}")
    if((file MATCHES "^scenarios" AND EXISTS "${source}/${file}")
        OR (part STREQUAL "" AND EXISTS "${pages}/${file}"))
      continue()
    endif()
    string(REGEX REPLACE "([.+])" "[\\1]" target "${target}")
    string(REGEX REPLACE "\\[([^]]*)\\]\\(${target}\\)" "\\1" text "${text}")
  endforeach()
  file(WRITE "${page}" "${text}")
endforeach()
