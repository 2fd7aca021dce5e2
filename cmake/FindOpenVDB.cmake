# OpenVDB::openvdb, where the library and the Boost headers that its own include are installed. (OpenVDB's own module
# asks for every library that it was built with.)
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_path(OpenVDB_BOOST_DIR boost/numeric/conversion/conversion_traits.hpp)
find_library(OpenVDB_LIBRARY openvdb)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR
                                          OpenVDB_BOOST_DIR)
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_BOOST_DIR OpenVDB_LIBRARY)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  find_package(TBB REQUIRED)
  find_package(Imath REQUIRED)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION ${OpenVDB_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR};${OpenVDB_BOOST_DIR}")
  target_link_libraries(OpenVDB::openvdb INTERFACE TBB::tbb Imath::Imath)
endif()
