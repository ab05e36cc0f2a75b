# find_package(evra) gives the target evra::evra: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. evra_SIGNATURE is what evra_signature() returns.
set(evra_SIGNATURE cfc2542b09605c49)

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
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/evra-${_modeler_kind}-cfc2542b09605c49.cmake")
  if(TARGET evra::evra OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET evra::evra) # installed by make
    if(_modeler_kind STREQUAL "shared")
      set(_modeler_name libevra_model.so.cfc2542b09605c49)
    else()
      set(_modeler_name libevra_model.a)
    endif()
    string(TOUPPER ${_modeler_kind} _modeler_type)
    add_library(evra::evra ${_modeler_type} IMPORTED)
    get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/evra" ABSOLUTE)
    set_target_properties(evra::evra PROPERTIES IMPORTED_LOCATION "${_modeler_location}"
      INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
    if(_modeler_kind STREQUAL "shared")
      set_target_properties(evra::evra PROPERTIES IMPORTED_SONAME "${_modeler_name}")
    endif()
  endif()
endforeach()

if(NOT TARGET evra::evra)
  set(evra_FOUND FALSE)
  set(evra_NOT_FOUND_MESSAGE
    "no library of signature cfc2542b09605c49 here that is ${_modeler_kinds}; install it again")
endif()
