# find_package(sr400) gives the target sr400::sr400: the kind that BUILD_SHARED_LIBS asks for, else the
# other; COMPONENTS static or shared insists. sr400_SIGNATURE is what sr400_signature() returns.
set(sr400_SIGNATURE 255a7ceab36c9010)

if(sr400_FIND_COMPONENTS)
  set(_modeler_kinds ${sr400_FIND_COMPONENTS})
elseif(BUILD_SHARED_LIBS)
  set(_modeler_kinds shared static)
else()
  set(_modeler_kinds static shared)
endif()
set(_modeler_lib "${CMAKE_CURRENT_LIST_DIR}/../..")

foreach(_modeler_kind IN LISTS _modeler_kinds)
  # A library of another signature that is left in the same place has another file.
  set(_modeler_file "${CMAKE_CURRENT_LIST_DIR}/sr400-${_modeler_kind}-255a7ceab36c9010.cmake")
  if(TARGET sr400::sr400 OR NOT EXISTS "${_modeler_file}")
    continue()
  endif()
  include("${_modeler_file}")
  if(NOT TARGET sr400::sr400) # installed by make
    if(_modeler_kind STREQUAL "shared")
      set(_modeler_name libsr400_model.so.255a7ceab36c9010)
    else()
      set(_modeler_name libsr400_model.a)
    endif()
    string(TOUPPER ${_modeler_kind} _modeler_type)
    add_library(sr400::sr400 ${_modeler_type} IMPORTED)
    get_filename_component(_modeler_location "${_modeler_lib}/${_modeler_name}" ABSOLUTE)
    get_filename_component(_modeler_include "${_modeler_lib}/../include/sr400" ABSOLUTE)
    set_target_properties(sr400::sr400 PROPERTIES IMPORTED_LOCATION "${_modeler_location}"
      INTERFACE_INCLUDE_DIRECTORIES "${_modeler_include}" INTERFACE_LINK_LIBRARIES m)
    if(_modeler_kind STREQUAL "shared")
      set_target_properties(sr400::sr400 PROPERTIES IMPORTED_SONAME "${_modeler_name}")
    endif()
  endif()
endforeach()

if(NOT TARGET sr400::sr400)
  set(sr400_FOUND FALSE)
  set(sr400_NOT_FOUND_MESSAGE
    "no library of signature 255a7ceab36c9010 here that is ${_modeler_kinds}; install it again")
endif()
