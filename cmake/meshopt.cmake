# SPDX-License-Identifier: MIT
# LOFT_MESHOPT: whether io packs and unpacks glTF. By default where meshoptimizer is found.
find_package(meshoptimizer CONFIG QUIET)
set(loft_has_meshopt OFF)
if(TARGET meshoptimizer::meshoptimizer)
  set(loft_has_meshopt ON)
endif()
loft_optional(MESHOPT ${loft_has_meshopt} "Pack and unpack glTF (EXT_meshopt_compression)"
  "packed glTF" meshoptimizer libmeshoptimizer-dev)
