// Earlier programs' name of an observer.
#ifndef BTR_OPENR_OOBSERVERVECTOR_H
#define BTR_OPENR_OOBSERVERVECTOR_H

#include <OPENR/OObserver.h>

typedef class OObserver OObserverVector;

#endif
