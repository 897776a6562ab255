/* Of these headers. A module is run by a run-time of the same number only: it goes up by one whenever a class, a
   structure or a macro in this folder changes in a way that what was compiled before does not know. */
#ifndef BTR_OPENR_VERSION_H
#define BTR_OPENR_VERSION_H

#define BTR_OPENR_VERSION "3"
#define BTR_OPENR_MARK "uchilsim-openr-headers "

#endif
