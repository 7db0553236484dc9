# Finds or fetches LAMMPS and describes its stock build: one static library, made by LAMMPS's own CMake.

# ---------------------------------------------------------------------- what it needs
find_package(MPI QUIET COMPONENTS CXX)
if(NOT MPI_CXX_FOUND)
  hvi_stop("no MPI found: install one (Debian: apt-get install openmpi-bin libopenmpi-dev) or set MPI_CXX_COMPILER")
endif()
find_package(Eigen3 QUIET NO_MODULE)
find_package(JPEG QUIET)
find_package(PNG QUIET)
set(missing "")
foreach(p Eigen3:libeigen3-dev JPEG:libjpeg-dev PNG:libpng-dev)
  string(REPLACE ":" ";" p ${p})
  list(GET p 0 name)
  list(GET p 1 package)
  if(NOT ${name}_FOUND)
    string(APPEND missing " ${package}")
  endif()
endforeach()
if(missing)
  hvi_stop("missing libraries: install them (Debian: apt-get install${missing})")
endif()
find_package(Threads REQUIRED)

# ---------------------------------------------------------------------- source
if(LAMMPS_SOURCE_DIR)
  set(LAMMPS_DIR ${LAMMPS_SOURCE_DIR})
  if(EXISTS ${LAMMPS_DIR}/version.h)
    get_filename_component(LAMMPS_DIR ${LAMMPS_DIR} DIRECTORY)
  endif()
  if(NOT EXISTS ${LAMMPS_DIR}/src/version.h OR NOT EXISTS ${LAMMPS_DIR}/cmake/CMakeLists.txt)
    hvi_stop("LAMMPS_SOURCE_DIR=${LAMMPS_SOURCE_DIR} is not a LAMMPS source tree: give the folder that holds src/ and cmake/")
  endif()
  get_filename_component(LAMMPS_DIR ${LAMMPS_DIR} REALPATH)
else()
  message(STATUS "LAMMPS ${HVI_LAMMPS_VERSION}")
  hvi_script(LAMMPS_DIR ${CMAKE_CURRENT_SOURCE_DIR}/fetch.sh ${HVI_LAMMPS_VERSION})
endif()

file(STRINGS ${LAMMPS_DIR}/src/version.h line REGEX "LAMMPS_VERSION")
string(REGEX REPLACE ".*\"(.*)\".*" "\\1" LAMMPS_VERSION_NAME "${line}")
if(NOT LAMMPS_VERSION_NAME IN_LIST HVI_TESTED_VERSIONS AND NOT HVI_ALLOW_UNTESTED)
  string(JOIN " or " tested ${HVI_TESTED_VERSIONS})
  hvi_stop("${LAMMPS_DIR} is LAMMPS ${LAMMPS_VERSION_NAME}, but this package was tested with ${tested}: use one of these, "
           "or try it with HVI_ALLOW_UNTESTED=ON")
endif()

# ---------------------------------------------------------------------- stock build
# GRAPHICS holds "dump image" since 2026; packages that a version does not have are left out
set(STOCK_PACKAGES SPH MACHDYN BPM PERI MOLECULE GRANULAR PLUGIN GRAPHICS
    EXTRA-COMMAND EXTRA-COMPUTE EXTRA-DUMP EXTRA-FIX EXTRA-MOLECULE EXTRA-PAIR)
set(HVI_ARCH_FLAGS "")
set(arch "")
if(NOT HVI_PORTABLE)
  set(HVI_ARCH_FLAGS -march=native)
  # what "native" means on this machine: a cache folder may be shared between machines
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -E -v -x c++ /dev/null
                  OUTPUT_QUIET ERROR_VARIABLE arch)
  string(REGEX MATCHALL " -m[^ \n]+| --param [^ ]+" arch "${arch}")
endif()

set(STOCK_OPTIONS
    -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} ${HVI_ARCH_FLAGS}" "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG"
    -DCMAKE_CXX_STANDARD=17 -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_SHARED_LIBS=OFF
    -DBUILD_MPI=ON -DMPI_CXX_COMPILER=${MPI_CXX_COMPILER} -DBUILD_OMP=OFF -DDOWNLOAD_EIGEN3=OFF
    -DWITH_PNG=ON -DWITH_JPEG=ON -DWITH_GZIP=OFF -DWITH_FFMPEG=OFF -DWITH_CURL=OFF)
if(NOT HVI_SIZES STREQUAL "smallbig")
  file(STRINGS ${LAMMPS_DIR}/cmake/CMakeLists.txt known REGEX "^set\\(LAMMPS_SIZES_VALUES")
  string(REGEX REPLACE ".*VALUES (.*)\\)" "\\1" known "${known}")
  string(REPLACE " " ";" sizes "${known}")
  if(NOT HVI_SIZES IN_LIST sizes)
    hvi_stop("LAMMPS ${LAMMPS_VERSION_NAME} has no integers \"${HVI_SIZES}\": take one of ${known}")
  endif()
  list(APPEND STOCK_OPTIONS -DLAMMPS_SIZES=${HVI_SIZES})
endif()
foreach(p ${STOCK_PACKAGES})
  if(EXISTS ${LAMMPS_DIR}/src/${p})
    list(APPEND STOCK_OPTIONS -DPKG_${p}=ON)
  endif()
endforeach()

if(LAMMPS_SOURCE_DIR)
  set(STOCK_DIR ${CMAKE_BINARY_DIR}/lammps)
  # another tree or other options than last time
  string(SHA256 key "${LAMMPS_DIR};${STOCK_OPTIONS};${arch}")
  set(old "")
  if(EXISTS ${STOCK_DIR}/key)
    file(READ ${STOCK_DIR}/key old)
  endif()
  if(NOT old STREQUAL key)
    file(REMOVE_RECURSE ${STOCK_DIR})
    file(WRITE ${STOCK_DIR}/key ${key})
  endif()
else()
  get_filename_component(cache ${LAMMPS_DIR} DIRECTORY)
  string(SHA256 key "1;${STOCK_OPTIONS};${arch};${CMAKE_CXX_COMPILER_ID};${CMAKE_CXX_COMPILER_VERSION};${MPI_CXX_LIBRARIES};${MPI_CXX_INCLUDE_DIRS};${CMAKE_SYSTEM_PROCESSOR}")
  string(SUBSTRING ${key} 0 12 key)
  set(STOCK_DIR ${cache}/built-${HVI_LAMMPS_VERSION}-${key})
endif()
hvi_script(ignored ${CMAKE_CURRENT_SOURCE_DIR}/stock.sh configure ${STOCK_DIR} ${LAMMPS_DIR} ${STOCK_OPTIONS})
include(${STOCK_DIR}/flags.cmake)  # -> STOCK_DEFINES, STOCK_INCLUDES, STOCK_SYSTEM_INCLUDES
set(LAMMPS_STYLES ${STOCK_DIR}/styles)

add_library(stock STATIC IMPORTED GLOBAL)
set_target_properties(stock PROPERTIES IMPORTED_LOCATION ${STOCK_DIR}/liblammps.a)
target_link_libraries(stock INTERFACE MPI::MPI_CXX JPEG::JPEG PNG::PNG Threads::Threads ${CMAKE_DL_LIBS})
if(LAMMPS_SOURCE_DIR)
  # the tree may be edited: let LAMMPS's own build look each time
  add_custom_target(stock-build COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/stock.sh build ${STOCK_DIR} keep
                    BYPRODUCTS ${STOCK_DIR}/liblammps.a USES_TERMINAL COMMENT "")
else()
  add_custom_command(OUTPUT ${STOCK_DIR}/liblammps.a
                     COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/stock.sh build ${STOCK_DIR} drop USES_TERMINAL COMMENT "")
  add_custom_target(stock-build DEPENDS ${STOCK_DIR}/liblammps.a)
endif()
