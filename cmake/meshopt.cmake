# SPDX-License-Identifier: MIT
# LOFT_MESHOPT: whether io packs and unpacks glTF. By default where meshoptimizer is found.
find_package(meshoptimizer CONFIG QUIET)
set(loft_has_meshopt OFF)
if(TARGET meshoptimizer::meshoptimizer)
  set(loft_has_meshopt ON)
endif()
option(LOFT_MESHOPT "Pack and unpack glTF (EXT_meshopt_compression); needs meshoptimizer"
  ${loft_has_meshopt})
if(LOFT_MESHOPT AND NOT loft_has_meshopt)
  message(WARNING "LOFT_MESHOPT is on, but there is no meshoptimizer: install libmeshoptimizer-dev")
  set(LOFT_MESHOPT OFF)
endif()
if(LOFT_MESHOPT)
  message(STATUS "With packed glTF, by meshoptimizer")
else()
  message(STATUS "Without packed glTF: libmeshoptimizer-dev is not installed, or LOFT_MESHOPT=OFF")
endif()
