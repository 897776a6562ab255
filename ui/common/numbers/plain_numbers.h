#pragma once

namespace btr::ui {

/// Numbers have a decimal point everywhere, as in files and on the command line, whatever the user's locale says: in
/// Qt's texts, and in what the C library reads and writes. (Qt takes the user's locale for the latter, too, as an
/// application begins.) To be called once there is an application.
void usePlainNumbers();

}  // namespace btr::ui
