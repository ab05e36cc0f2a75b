# find_package(five_bar) gives the target five_bar::five_bar: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. five_bar_SIGNATURE is what five_bar_signature() returns.
set(five_bar_SIGNATURE c7cd854564dea4f6)

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
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/five_bar-${_modeler_kind}-c7cd854564dea4f6.cmake")
  if(TARGET five_bar::five_bar OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET five_bar::five_bar) # installed by make
    if(_modeler_kind STREQUAL "shared")
      set(_modeler_name libfive_bar_model.so.c7cd854564dea4f6)
    else()
      set(_modeler_name libfive_bar_model.a)
    endif()
    string(TOUPPER ${_modeler_kind} _modeler_type)
    add_library(five_bar::five_bar ${_modeler_type} IMPORTED)
    get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/five_bar" ABSOLUTE)
    set_target_properties(five_bar::five_bar PROPERTIES IMPORTED_LOCATION "${_modeler_location}"
      INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
    if(_modeler_kind STREQUAL "shared")
      set_target_properties(five_bar::five_bar PROPERTIES IMPORTED_SONAME "${_modeler_name}")
    endif()
  endif()
endforeach()

if(NOT TARGET five_bar::five_bar)
  set(five_bar_FOUND FALSE)
  set(five_bar_NOT_FOUND_MESSAGE
    "no library of signature c7cd854564dea4f6 here that is ${_modeler_kinds}; install it again")
endif()
