# Kernel files that include others, as EMBED makes one string of them, in WORK.
cmake_minimum_required(VERSION 3.18)

# The string of some files of WORK, and what the script said, empty where it succeeded.
function(embed files)
  list(TRANSFORM files PREPEND "${WORK}/kernels/")
  file(REMOVE ${WORK}/kernels.h)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/kernels.h "-DKERNELS=${files}" -P ${EMBED}
    RESULT_VARIABLE result ERROR_VARIABLE error)
  set(embedded "")
  if(EXISTS ${WORK}/kernels.h)
    file(READ ${WORK}/kernels.h embedded)
  endif()
  if(result EQUAL 0)
    set(error "")
  endif()
  set(embedded "${embedded}" PARENT_SCOPE)
  set(error "${error}" PARENT_SCOPE)
endfunction()

# That the functions of the files follow each other so.
function(expect_order expected)
  string(REGEX MATCHALL "kernel void [a-z]+" functions "${embedded}")
  list(TRANSFORM functions REPLACE "kernel void " "")
  if(NOT functions STREQUAL expected OR embedded MATCHES "#include")
    message(SEND_ERROR "Not ${expected}, but ${functions}: ${error}${embedded}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(WRITE ${WORK}/kernels/alone.cl "kernel void alone();\n")
file(WRITE ${WORK}/kernels/common.cl "int a[2]; /* ] */\nkernel void common();\n")
file(WRITE ${WORK}/kernels/first.cl "#include \"common.cl\"\nkernel void first();\n")
file(WRITE ${WORK}/kernels/second.cl
  "/* \"]; */\n#include \"middle.cl\"\n#include \"common.cl\"\nkernel void second();\n")
file(WRITE ${WORK}/kernels/middle.cl
  "kernel void before();\n#include \"common.cl\"\nkernel void middle();\n")
file(WRITE ${WORK}/kernels/circle.cl "#include \"circle.cl\"\nkernel void circle();\n")

embed("alone.cl")
expect_order("alone")
embed("first.cl;second.cl")
expect_order("common;first;before;middle;second")
embed("second.cl;common.cl;first.cl;middle.cl") # as a listing of the folder has them
expect_order("before;common;middle;second;first")
embed("circle.cl")
expect_order("circle")

file(WRITE ${WORK}/kernels/wrong.cl "#include \"comon.cl\"\nkernel void wrong();\n")
embed("alone.cl;wrong.cl")
if(NOT error MATCHES "comon.cl,[ \n]+which[ \n]+does[ \n]+not[ \n]+exist"
   OR embedded)
  message(SEND_ERROR "No error, or a header all the same: ${error}${embedded}")
endif()
