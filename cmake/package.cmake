# Debian packages by CPack: toryu (all that runs cases) and toryu-dev (what another fluid or solid is built with).
#
#     tools/install.sh run python package && tools/build.sh package && cpack --preset package
set(CPACK_PACKAGE_CONTACT "The toryu authors" CACHE STRING "Who answers for the packages: name and address of mail")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME toryu)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "fluid-structure co-simulation by smoothed particle hydrodynamics
A weakly compressible fluid (delta-SPH) against an elastic solid, in two
dimensions, as processes that are coupled over DDS. Cases and studies are
text files; a run ends in a report. The programs are built for every level
of x86-64, and the processor decides which of them runs.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, python3-h5py")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "openssl, python3-matplotlib, python3-svgelements, python3-ezdxf")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME toryu-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "build another fluid or solid for toryu
A library and headers for programs that take the place of the fluid or of the
solid in a coupled run of toryu, and a CMake package: find_package(toryu).")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "toryu (= ${PROJECT_VERSION}), cyclonedds-dev, libcereal-dev, libeigen3-dev, \
libfmt-dev, libspdlog-dev, libssl-dev, libtomlplusplus-dev, libxxhash-dev, zlib1g-dev")
include(CPack)
