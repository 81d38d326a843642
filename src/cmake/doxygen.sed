# Doxygen's input filter: the comments of our headers, which are plain, as it wants them.
# A backslash in a comment is one.
/^ *\/\//s#\\#\\\\#g
# The first line of a header says what is in it.
1s#^// \(.*\)#/// \\file\n/// \1#
# A comment above a declaration, and one behind it.
s#^\( *\)//\($\| \)#\1///\2#
s#\([^ /].*\)  // #\1  ///< #
# What stands in angle brackets is no HTML.
/\/\/\//s#<\([a-z]*\)>#\\<\1>#g
