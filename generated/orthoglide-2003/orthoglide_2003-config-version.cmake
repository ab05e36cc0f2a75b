# find_package(orthoglide_2003) takes any, find_package(orthoglide_2003 2) any of this C interface,
# find_package(orthoglide_2003 2.61054.55828.35374) only what has the signature ee7eda148a2ec3f0.
set(PACKAGE_VERSION 2.61054.55828.35374)
set(PACKAGE_VERSION_COMPATIBLE FALSE)
set(PACKAGE_VERSION_EXACT FALSE)
if("${PACKAGE_FIND_VERSION}" STREQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  set(PACKAGE_VERSION_EXACT TRUE)
elseif("${PACKAGE_FIND_VERSION}" STREQUAL "2")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
