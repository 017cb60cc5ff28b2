# Writes OUTPUT: a C++ file whose page_source() returns the text of FILE.
file(READ ${FILE} hex HEX)
string(LENGTH "${hex}" digits)
math(EXPR bytes "${digits} / 2")
string(REGEX REPLACE "(..)" "'\\\\x\\1'," characters "${hex}")
file(WRITE ${OUTPUT} "#include \"tradeoff/page_maker.h\"\n\nnamespace voxilux {\nnamespace {\n\n"
  "constexpr char kText[] = {${characters}'\\0'};\n\n}  // namespace\n\n"
  "std::string_view page_source() {\n    return {kText, ${bytes}};\n}\n\n}  // namespace voxilux\n")
