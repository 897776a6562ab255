#ifndef BTR_OPENR_ANTSTACKREF_H
#define BTR_OPENR_ANTSTACKREF_H

#include <antTypes.h>

/// The IP stack, by its name: "IPStack".
class antStackRef {
 public:
  antStackRef() : disp_(0) {}
  antStackRef(const OID& oid_) : oid(oid_), disp_(0) {}
  antStackRef(const MAV_Dispatcher* disp) : disp_(const_cast<MAV_Dispatcher*>(disp)) {}
  antStackRef(const char* name_);
  ~antStackRef() {}
  OID& get_oid() { return oid; }
  MAV_Dispatcher* get_disp() { return disp_; }
  bool IsValid() { return oid.IsValid(); }

 private:
  OID oid;
  MAV_Dispatcher* disp_;
};

#endif
