# SPDX-License-Identifier: MIT
# cmake -P words.cmake SPIRV WORDS
# Writes the words of a SPIR-V file as hexadecimal numbers, which a C++ array includes. The file is in little-endian order.
file(READ ${CMAKE_ARGV3} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${bytes}")
file(WRITE ${CMAKE_ARGV4} "${words}")
