# In a unit of many files a local name may hide another file's, which GCC alone tells from a local that hides a local or a
# parameter; and GCC takes the anonymous namespaces of a unit's files for ones of headers. The debug preset, file by file, warns
# of all shadows.
set(MROSE_UNIT_WARNINGS -Wshadow)
if(CMAKE_UNITY_BUILD)
  set(MROSE_UNIT_WARNINGS $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local> $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

# Flags of every target. Nothing that ships is built for one processor (-march=native): kernels that profit from wider
# instruction sets are compiled several times and chosen at run time.
add_library(mrose_flags INTERFACE)
target_compile_options(mrose_flags INTERFACE
  -Wall -Wextra -Wpedantic ${MROSE_UNIT_WARNINGS} -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough -Werror
  # Members have defaults: an initializer that leaves some out is complete.
  -Wno-missing-field-initializers
  # GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651), and optionals that are read unset
  # (80635); clang, clang-tidy and the sanitizers look for real ones.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  # A fused multiply-add rounds once where two instructions round twice: what feeds the state must not depend on it. (Nor
  # does core round doubles to floats and back: GCC 12 forgets that of pairs which it puts into one register.)
  -ffp-contract=off
  # Nobody reads errno after a square root, which is one instruction then.
  -fno-math-errno)

# What __FILE__ and debugging symbols say of a source begins at the root: objects do not depend on where the clone lies.
target_compile_options(mrose_flags INTERFACE -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)

if(MROSE_SANITIZE)
  target_compile_options(mrose_flags INTERFACE -fsanitize=${MROSE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(mrose_flags INTERFACE -fsanitize=${MROSE_SANITIZE})
  # An empty optional that is read or an index beyond a vector's end is memory that there is: the library tells it.
  target_compile_definitions(mrose_flags INTERFACE _GLIBCXX_ASSERTIONS)
  if(MROSE_SANITIZE MATCHES "address")
    target_compile_definitions(mrose_flags INTERFACE MROSE_ADDRESS_SANITIZER)
    # Left out of what is checked at each access of memory: the address sanitizer or the processor finds it.
    target_compile_options(mrose_flags INTERFACE -fno-sanitize=null,object-size)
  endif()
  if(MROSE_SANITIZE MATCHES "thread")
    target_compile_definitions(mrose_flags INTERFACE MROSE_THREAD_SANITIZER)
  endif()
endif()
