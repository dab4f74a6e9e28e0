# SPDX-License-Identifier: MIT
# cmake --build BUILD --target docs: the reference of all public headers, in BUILD/docs/html, where
# Doxygen is found. What it warns of is an error.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()

set(loft_headers)
foreach(layer IN ITEMS cdt overlay paths fields mesh reconstruct io)
  get_target_property(headers loft_${layer} HEADER_SET)
  get_target_property(folder loft_${layer} SOURCE_DIR)
  foreach(header IN LISTS headers)
    cmake_path(ABSOLUTE_PATH header BASE_DIRECTORY ${folder})
    list(APPEND loft_headers ${header})
  endforeach()
endforeach()

file(CONFIGURE OUTPUT docs/mainpage.md @ONLY CONTENT [[
# Loft

@PROJECT_DESCRIPTION@. Begin with loft::reconstruct(), loft::Reconstruction, loft::io::read_stack()
and loft::io::write(); the triangulation below them all is loft::cdt::Triangulation.
]])
set(DOXYGEN_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/docs)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${CMAKE_CURRENT_BINARY_DIR}/docs/mainpage.md)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_STRIP_FROM_INC_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_QUIET YES)
# What says all by its name and type has no comment; it is listed all the same.
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
doxygen_add_docs(docs ${loft_headers} ${CMAKE_CURRENT_BINARY_DIR}/docs/mainpage.md
  COMMENT "Making the reference in docs/html")
