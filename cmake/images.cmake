# SPDX-License-Identifier: MIT
# LOFT_TIFF, LOFT_PNG: whether io reads series of such images. By default where libtiff and libpng
# are found.
find_package(TIFF 4.5 QUIET)
find_package(PNG 1.6 QUIET)

# loft_image_format(NAME LIBRARY PACKAGE): the option LOFT_NAME, off without target NAME::NAME.
function(loft_image_format name library package)
  set(is_there OFF)
  if(TARGET ${name}::${name})
    set(is_there ON)
  endif()
  option(LOFT_${name} "Read series of ${name} images; needs ${library}" ${is_there})
  if(LOFT_${name} AND NOT is_there)
    message(WARNING "LOFT_${name} is on, but there is no ${library}: install ${package}")
    set(LOFT_${name} OFF)
    set(LOFT_${name} OFF PARENT_SCOPE)
  endif()
  if(LOFT_${name})
    message(STATUS "With ${name}, by ${library} ${${name}_VERSION_STRING}")
  else()
    message(STATUS "Without ${name}: ${package} is not installed, or LOFT_${name}=OFF")
  endif()
endfunction()
loft_image_format(TIFF libtiff libtiff-dev)
loft_image_format(PNG libpng libpng-dev)
