# Where CMAKE_UNITY_BUILD is on, the files of a folder are compiled as one: most of the time goes into the libraries' headers.
# Files of the folders named after the target stay apart.
# Clang's static analyzer follows paths through the files of such a unit only where its name has "UnifiedSource" in it.
function(one_unit_a_folder target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(GET folder FILENAME name)
    if(NOT name IN_LIST ARGN)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP UnifiedSource_${name})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()
