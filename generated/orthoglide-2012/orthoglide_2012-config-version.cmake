# find_package(orthoglide_2012) takes any, find_package(orthoglide_2012 1) any of this C interface,
# find_package(orthoglide_2012 1.27214.52406.65373) only what has the signature 6a4eccb6ff5dbaef.
set(PACKAGE_VERSION 1.27214.52406.65373)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "1")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
