// What the two objects share: an object of C++ in a region, which both write to.
#ifndef State_h
#define State_h

class Named {
 public:
  virtual ~Named() {}
  virtual int sum() const = 0;
};

class State : public Named {
 public:
  State() : ears(1), legs(2) {}
  virtual int sum() const { return ears + legs; }
  int ears, legs;
};

#endif
