# find_package(orthoglide_2012) takes any, find_package(orthoglide_2012 1) any of this C interface,
# find_package(orthoglide_2012 1.43494.60107.61077) only what has the signature a9e6eacbee95b034.
set(PACKAGE_VERSION 1.43494.60107.61077)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "1")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
