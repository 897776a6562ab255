#pragma once

namespace btr {

/// Makes SQLite's locks belong to open files (Linux: F_OFD_SETLK) instead of to the process. POSIX record locks, which
/// SQLite takes by itself, are all gone as soon as anything in the process closes any descriptor of the same file: a
/// file dialog that looks into files to choose their icons is enough. Another process then believes that it is alone
/// and removes the write-ahead log that this one still reads and writes; what is written there afterwards is lost.
/// To be called before the first database of the process is opened; further calls do nothing. Locks of both kinds keep
/// each other out, so other programs may use the file at the same time.
void lockFilesOfSqliteByDescription();

}  // namespace btr
