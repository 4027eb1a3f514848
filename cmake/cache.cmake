# A compiler cache where there is one. All clones and build folders profit from each other's objects: paths are told relative
# to the clone, and no object knows the folder that it was compiled in. CCACHE_DISABLE=1 in the environment goes without.
find_program(MROSE_CCACHE ccache)
if(MROSE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${MROSE_CCACHE})
endif()
