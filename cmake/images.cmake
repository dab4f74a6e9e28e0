# SPDX-License-Identifier: MIT
# LOFT_TIFF, LOFT_PNG: whether io reads series of such images. By default where libtiff and libpng
# are found.
find_package(TIFF 4.5 QUIET)
find_package(PNG 1.6 QUIET)

foreach(format IN ITEMS TIFF PNG)
  string(TOLOWER lib${format} library)
  set(is_there OFF)
  if(TARGET ${format}::${format})
    set(is_there ON)
  endif()
  loft_optional(${format} ${is_there} "Read series of ${format} images" ${format} ${library} ${library}-dev
    ${${format}_VERSION_STRING})
endforeach()
