# SPDX-License-Identifier: MIT
# loft_optional(NAME IS_THERE DOES WHAT LIBRARY PACKAGE [VERSION]): the option LOFT_NAME, whether io does
# something ("Read DICOM, RTSTRUCT and SEG") for which it needs a library of a Debian package; by
# default if that IS_THERE, off without it. WHAT is what a build has then, or lacks.
function(loft_optional name is_there does what library package)
  option(LOFT_${name} "${does}; needs ${library}" ${is_there})
  if(LOFT_${name} AND NOT is_there)
    message(WARNING "LOFT_${name} is on, but there is no ${library}: install ${package}")
    set(LOFT_${name} OFF)
    set(LOFT_${name} OFF PARENT_SCOPE)
  endif()
  if(LOFT_${name})
    string(STRIP "${library} ${ARGN}" by)
    message(STATUS "With ${what}, by ${by}")
  else()
    message(STATUS "Without ${what}: ${package} is not installed, or LOFT_${name}=OFF")
  endif()
endfunction()
