# find_package(orthoglide_2012) takes any, find_package(orthoglide_2012 1) any of this C interface,
# find_package(orthoglide_2012 1.27320.544.55825) only what has the signature 6ab80220da111dbb.
set(PACKAGE_VERSION 1.27320.544.55825)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "1")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
