# What `cmake --install` puts where. An installation has the layout of the sources under lib/toryu, so that the programs
# and the Python parts find each other there as they do here:
#
#     bin/toryu                    the command; fluid_solver, solid_solver and coupler beside it are links to it
#     lib/toryu/programs           the programs; of a portable build a folder for each level of x86-64
#     lib/toryu/tools/toryu        the Python parts; lib/python3/dist-packages/toryu is a link to them
#     include/toryu, libtoryu_participant.a, cmake/toryu     for `find_package(toryu)`: toryu::participant
#     share/toryu/cases, share/toryu/examples, share/doc/toryu, share/man, share/bash-completion
#
# Component `programs` is all that runs cases; `development` is what another fluid or solid is built with.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(root lib/toryu)
set(commands fluid_solver solid_solver coupler) # what is started by hand too
set(programs ${commands} replayed_fluid replayed_solid reference_loop)
set(modules)
if(TORYU_PYTHON)
  set(modules toryu_participant)
endif()

function(toryu_install_programs from to)
  list(TRANSFORM programs PREPEND ${from}/ OUTPUT_VARIABLE files)
  install(PROGRAMS ${files} DESTINATION ${root}/programs/${to} COMPONENT programs)
  install(FILES ${from}/commit.txt DESTINATION ${root}/programs/${to} COMPONENT programs OPTIONAL)
  foreach(module ${modules})
    install(DIRECTORY ${from}/ DESTINATION ${root}/programs/${to} COMPONENT programs FILES_MATCHING PATTERN ${module}.*)
  endforeach()
endfunction()

# The levels are those of tools/toryu/installation.py. This build is for the oldest; the others are builds of their own.
if(TORYU_PORTABLE)
  if(NOT TORYU_CPU STREQUAL "x86-64")
    message(FATAL_ERROR "TORYU_PORTABLE=ON goes with TORYU_CPU=x86-64, not with '${TORYU_CPU}'")
  endif()
  include(ExternalProject)
  foreach(setting CMAKE_BUILD_TYPE CMAKE_C_COMPILER CMAKE_CXX_COMPILER CMAKE_EXE_LINKER_FLAGS CMAKE_SKIP_RPATH
      TORYU_PYTHON TORYU_WARNINGS_AS_ERRORS)
    list(APPEND same -D${setting}=${${setting}})
  endforeach()
  foreach(level x86-64-v3 x86-64-v4)
    ExternalProject_Add(programs_${level}
      SOURCE_DIR ${PROJECT_SOURCE_DIR}
      BINARY_DIR ${CMAKE_BINARY_DIR}/${level}
      CMAKE_ARGS ${same} -DTORYU_CPU=${level} -DTORYU_TESTS=OFF
      BUILD_COMMAND ${CMAKE_COMMAND} --build <BINARY_DIR> --target ${programs} ${modules} toryu_commit
      BUILD_ALWAYS ON
      INSTALL_COMMAND ""
      USES_TERMINAL_BUILD ON) # one after the other
    toryu_install_programs(${CMAKE_BINARY_DIR}/${level}/bin ${level})
  endforeach()
  toryu_install_programs(${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${TORYU_CPU})
else()
  toryu_install_programs(${CMAKE_RUNTIME_OUTPUT_DIRECTORY} "")
endif()

# The command, the Python parts and what they read.
install(PROGRAMS tools/command.py DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME toryu COMPONENT programs)
install(DIRECTORY tools/toryu DESTINATION ${root}/tools COMPONENT programs PATTERN __pycache__ EXCLUDE PATTERN *.md EXCLUDE)
install(PROGRAMS tools/install.sh DESTINATION ${root}/tools COMPONENT programs)
install(FILES tools/packages.txt DESTINATION ${root}/tools COMPONENT programs)
install(FILES common/scene/results_files.inc DESTINATION ${root}/common/scene COMPONENT programs)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/toryu COMPONENT programs PATTERN __pycache__ EXCLUDE)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/toryu COMPONENT programs USE_SOURCE_PERMISSIONS
  PATTERN __pycache__ EXCLUDE)
install(FILES tools/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME toryu
  COMPONENT programs)
function(toryu_install_link target link)
  get_filename_component(folder ${link} DIRECTORY)
  get_filename_component(name ${link} NAME)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/links/${folder})
  file(CREATE_LINK ${target} ${CMAKE_BINARY_DIR}/links/${folder}/${name} SYMBOLIC)
  install(FILES ${CMAKE_BINARY_DIR}/links/${folder}/${name} DESTINATION ${folder} COMPONENT programs)
endfunction()
foreach(command ${commands})
  toryu_install_link(toryu ${CMAKE_INSTALL_BINDIR}/${command})
  toryu_install_link(toryu ${CMAKE_INSTALL_DATADIR}/bash-completion/completions/${command})
endforeach()
toryu_install_link(../../toryu/tools/toryu lib/python3/dist-packages/toryu)

# What is written for users, at its place beside each other.
file(GLOB_RECURSE texts RELATIVE ${PROJECT_SOURCE_DIR} common/*.md coupler/*.md docs/*.md fluid_solver/*.md replay/*.md
  solid_solver/*.md tests/participants/*.md tools/*.md)
foreach(text README.md CHANGELOG.md VALIDATION.md ${texts})
  get_filename_component(folder ${text} DIRECTORY)
  install(FILES ${text} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/toryu/${folder} COMPONENT programs)
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/toryu RENAME copyright COMPONENT programs)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/toryu-dev RENAME copyright COMPONENT development)

# The manual pages are the --help of what was just installed.
find_program(TORYU_HELP2MAN help2man)
if(TORYU_HELP2MAN)
  install(CODE "set(help2man \"${TORYU_HELP2MAN}\")
    set(version \"${PROJECT_VERSION}\")
    set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    set(bin \"\${prefix}/${CMAKE_INSTALL_BINDIR}\")
    set(pages \"\${prefix}/${CMAKE_INSTALL_MANDIR}/man1\")
    set(tools \"\${prefix}/${root}/tools\")
    include(\"${PROJECT_SOURCE_DIR}/cmake/manual_pages.cmake\")" COMPONENT programs)
else()
  message(STATUS "no help2man: an installation will have no manual pages")
endif()

# For whoever builds another fluid or solid: one library with all that its objects need of ours, and no option of ours.
set(parts toryu_link toryu_topics toryu_state toryu_files toryu_run toryu_scene toryu_case toryu_error)
list(TRANSFORM parts REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
add_library(participant STATIC ${objects})
add_library(toryu::participant ALIAS participant)
set_target_properties(participant PROPERTIES LINKER_LANGUAGE CXX OUTPUT_NAME toryu_participant)
target_compile_features(participant INTERFACE cxx_std_20)
target_link_libraries(participant INTERFACE Eigen3::Eigen cereal::cereal fmt::fmt
  $<LINK_ONLY:spdlog::spdlog> $<LINK_ONLY:tomlplusplus::tomlplusplus> $<LINK_ONLY:CycloneDDS::ddsc>
  $<LINK_ONLY:OpenMP::OpenMP_CXX> $<LINK_ONLY:ZLIB::ZLIB> $<LINK_ONLY:OpenSSL::Crypto> $<LINK_ONLY:xxhash>)
target_sources(participant INTERFACE FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES
  common/case/case_file.hpp common/case/input_file.hpp common/case/parameter_table.hpp common/error/failure.hpp
  common/link/participant.hpp common/run/interruption.hpp common/run/network.hpp common/run/options.hpp common/run/program.hpp common/run/provenance.hpp
  common/sph/lanes.hpp common/sph/points.hpp common/sph/tensor.hpp common/state/checkpoint.hpp common/state/field.hpp
  common/state/serialize.hpp common/vector.hpp)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/toryu)
install(TARGETS participant EXPORT toryu ARCHIVE COMPONENT development
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/toryu COMPONENT development)
install(EXPORT toryu NAMESPACE toryu:: FILE toryu_targets.cmake DESTINATION ${package} COMPONENT development)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/toryu-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/toryu-config.cmake ${CMAKE_BINARY_DIR}/toryu-config-version.cmake DESTINATION ${package}
  COMPONENT development)
