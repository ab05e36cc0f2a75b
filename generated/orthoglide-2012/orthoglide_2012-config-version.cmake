# find_package(orthoglide_2012) takes any, find_package(orthoglide_2012 2) any of this C interface,
# find_package(orthoglide_2012 2.14271.2027.60313) only what has the signature 37bf07ebeb99a4ee.
set(PACKAGE_VERSION 2.14271.2027.60313)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
