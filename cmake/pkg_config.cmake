# SPDX-License-Identifier: MIT
# loft.pc, for those who build without CMake: all libraries, in the order in which static ones are
# linked, and where their headers are, wherever the folder they are installed in is moved to.
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
  set(loft_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH loft_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" loft_prefix ${loft_prefix})
  set(loft_prefix "\${pcfiledir}/${loft_prefix}")
endif()
# OpenMesh is in our headers; static libraries cannot say what else they need.
set(loft_requires "openmesh")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND loft_requires ", tbb, tinygltf, sqlite3 >= 3.37, zlib")
  if(LOFT_TIFF)
    string(APPEND loft_requires ", libtiff-4")
  endif()
  if(LOFT_PNG)
    string(APPEND loft_requires ", libpng")
  endif()
  if(LOFT_3MF)
    string(APPEND loft_requires ", libzip")
  endif()
  set(loft_libcsv " -lcsv")  # it has no file of pkg-config's
  if(LOFT_MESHOPT)
    set(loft_meshopt " -lmeshoptimizer")  # nor has it
  endif()
  if(LOFT_DICOM)
    set(loft_dicom " -ldcmdata -loflog -lofstd")  # dcmtk.pc would link all of DCMTK
  endif()
endif()
file(CONFIGURE OUTPUT loft.pc @ONLY CONTENT [[
prefix=@loft_prefix@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@

Name: loft
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: @loft_requires@
Libs: -L${libdir} -lloft-io -lloft-reconstruct -lloft-mesh -lloft-fields -lloft-paths -lloft-overlay -lloft-cdt@loft_libcsv@@loft_meshopt@@loft_dicom@
Cflags: -I${includedir}/loft -ffp-contract=off
]])
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/loft.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
