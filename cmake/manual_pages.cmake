# Writes the manual pages of the commands in `bin` into `pages`, from what they say of themselves, and leaves none of the
# bytecode behind that this makes in `tools`.
file(MAKE_DIRECTORY ${pages})
foreach(about
    "toryu: runs cases and studies of fluid-structure interaction"
    "coupler: leads the coupled run of a fluid and a solid"
    "fluid_solver: computes a fluid by smoothed particle hydrodynamics"
    "solid_solver: computes an elastic solid by smoothed particle hydrodynamics")
  string(REGEX MATCH "^([a-z_]+): (.+)$" about "${about}")
  set(name ${CMAKE_MATCH_1})
  set(page ${pages}/${name}.1)
  execute_process(COMMAND ${help2man} --no-info --section=1 --source=toryu --version-string=${version} --name=${CMAKE_MATCH_2}
    --output=${page} ${bin}/${name} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB_RECURSE bytecode ${tools}/*.pyc)
foreach(file ${bytecode})
  get_filename_component(folder ${file} DIRECTORY)
  file(REMOVE_RECURSE ${folder})
endforeach()
