# find_package(orthoglide_2003) takes any, find_package(orthoglide_2003 1) any of this C interface,
# find_package(orthoglide_2003 1.64964.5830.51401) only what has the signature fdc416c6c8c9aeab.
set(PACKAGE_VERSION 1.64964.5830.51401)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "1")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
