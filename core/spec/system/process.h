#pragma once

namespace btr {

/// What every program does first, so that its files and pipes behave: writing to a pipe that nobody reads, or beyond
/// the largest size of a file, is an error rather than the end; standard input, output and error that were closed by
/// whoever started the program are there but cannot be read or written, so that no other file takes their numbers; a
/// crash inside a plugin names it on standard error.
void beginProgram();

}  // namespace btr
