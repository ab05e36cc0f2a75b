# find_package(orthoglide_2012) takes any, find_package(orthoglide_2012 2) any of this C interface,
# find_package(orthoglide_2012 2.16328.2270.47737) only what has the signature 3fc808deba79eddd.
set(PACKAGE_VERSION 2.16328.2270.47737)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
