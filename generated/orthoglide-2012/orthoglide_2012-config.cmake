# find_package(orthoglide_2012) gives the targets orthoglide_2012::orthoglide_2012 and orthoglide_2012::batch: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. orthoglide_2012_SIGNATURE is that of the whole folder.
set(orthoglide_2012_SIGNATURE 32a799aacf456c49)

if(orthoglide_2012_FIND_COMPONENTS)
  set(_modeler_kinds ${orthoglide_2012_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/orthoglide_2012-${_modeler_kind}-32a799aacf456c49.cmake")
  if(TARGET orthoglide_2012::orthoglide_2012 OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET orthoglide_2012::orthoglide_2012) # installed by make
    string(TOUPPER ${_modeler_kind} _modeler_type)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/orthoglide_2012" ABSOLUTE)
    foreach(_modeler_part orthoglide_2012 batch)
      set(_modeler_name liborthoglide_2012_batch)
      if(_modeler_part STREQUAL "orthoglide_2012")
        set(_modeler_name liborthoglide_2012_model)
      endif()
      if(_modeler_kind STREQUAL "shared")
        string(APPEND _modeler_name .so.32a799aacf456c49)
      else()
        string(APPEND _modeler_name .a)
      endif()
      add_library(orthoglide_2012::${_modeler_part} ${_modeler_type} IMPORTED)
      get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
      set_target_properties(orthoglide_2012::${_modeler_part} PROPERTIES
        IMPORTED_LOCATION "${_modeler_location}"
        INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
      if(_modeler_kind STREQUAL "shared")
        set_target_properties(orthoglide_2012::${_modeler_part} PROPERTIES IMPORTED_SONAME "${_modeler_name}")
      endif()
    endforeach()
    set_target_properties(orthoglide_2012::batch PROPERTIES INTERFACE_LINK_LIBRARIES orthoglide_2012::orthoglide_2012)
  endif()
endforeach()

if(NOT TARGET orthoglide_2012::orthoglide_2012)
  set(orthoglide_2012_FOUND FALSE)
  set(orthoglide_2012_NOT_FOUND_MESSAGE
    "no library of signature 32a799aacf456c49 here that is ${_modeler_kinds}; install it again")
endif()
