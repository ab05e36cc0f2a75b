# find_package(evra) gives the targets evra::evra and evra::batch: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. evra_SIGNATURE is that of the whole folder.
set(evra_SIGNATURE e1952a67b957d79a)

if(evra_FIND_COMPONENTS)
  set(_modeler_kinds ${evra_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/evra-${_modeler_kind}-e1952a67b957d79a.cmake")
  if(TARGET evra::evra OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET evra::evra) # installed by make
    string(TOUPPER ${_modeler_kind} _modeler_type)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/evra" ABSOLUTE)
    foreach(_modeler_part evra batch)
      set(_modeler_name libevra_batch)
      if(_modeler_part STREQUAL "evra")
        set(_modeler_name libevra_model)
      endif()
      if(_modeler_kind STREQUAL "shared")
        string(APPEND _modeler_name .so.e1952a67b957d79a)
      else()
        string(APPEND _modeler_name .a)
      endif()
      add_library(evra::${_modeler_part} ${_modeler_type} IMPORTED)
      get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
      set_target_properties(evra::${_modeler_part} PROPERTIES
        IMPORTED_LOCATION "${_modeler_location}"
        INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
      if(_modeler_kind STREQUAL "shared")
        set_target_properties(evra::${_modeler_part} PROPERTIES IMPORTED_SONAME "${_modeler_name}")
      endif()
    endforeach()
    set_target_properties(evra::batch PROPERTIES INTERFACE_LINK_LIBRARIES evra::evra)
  endif()
endforeach()

if(NOT TARGET evra::evra)
  set(evra_FOUND FALSE)
  set(evra_NOT_FOUND_MESSAGE
    "no library of signature e1952a67b957d79a here that is ${_modeler_kinds}; install it again")
endif()
