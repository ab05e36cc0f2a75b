# find_package(orthoglide_2012) takes any, find_package(orthoglide_2012 2) any of this C interface,
# find_package(orthoglide_2012 2.9227.55993.25282) only what has the signature 240bdab962c21cbb.
set(PACKAGE_VERSION 2.9227.55993.25282)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
