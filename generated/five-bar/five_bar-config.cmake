# find_package(five_bar) gives the targets five_bar::five_bar and five_bar::batch: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. five_bar_SIGNATURE is that of the whole folder.
set(five_bar_SIGNATURE d1c82fb9d880dc4b)

if(five_bar_FIND_COMPONENTS)
  set(_modeler_kinds ${five_bar_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/five_bar-${_modeler_kind}-d1c82fb9d880dc4b.cmake")
  if(TARGET five_bar::five_bar OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET five_bar::five_bar) # installed by make
    string(TOUPPER ${_modeler_kind} _modeler_type)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/five_bar" ABSOLUTE)
    foreach(_modeler_part five_bar batch)
      set(_modeler_name libfive_bar_batch)
      if(_modeler_part STREQUAL "five_bar")
        set(_modeler_name libfive_bar_model)
      endif()
      if(_modeler_kind STREQUAL "shared")
        string(APPEND _modeler_name .so.d1c82fb9d880dc4b)
      else()
        string(APPEND _modeler_name .a)
      endif()
      add_library(five_bar::${_modeler_part} ${_modeler_type} IMPORTED)
      get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
      set_target_properties(five_bar::${_modeler_part} PROPERTIES
        IMPORTED_LOCATION "${_modeler_location}"
        INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
      if(_modeler_kind STREQUAL "shared")
        set_target_properties(five_bar::${_modeler_part} PROPERTIES IMPORTED_SONAME "${_modeler_name}")
      endif()
    endforeach()
    set_target_properties(five_bar::batch PROPERTIES INTERFACE_LINK_LIBRARIES five_bar::five_bar)
  endif()
endforeach()

if(NOT TARGET five_bar::five_bar)
  set(five_bar_FOUND FALSE)
  set(five_bar_NOT_FOUND_MESSAGE
    "no library of signature d1c82fb9d880dc4b here that is ${_modeler_kinds}; install it again")
endif()
