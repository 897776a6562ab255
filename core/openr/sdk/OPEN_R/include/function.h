// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_FUNCTION_H
#define BTR_OPENR_OLD_FUNCTION_H

#include <functional>

using std::binary_function;
using std::binary_negate;
using std::bind1st;
using std::bind2nd;
using std::binder1st;
using std::binder2nd;
using std::divides;
using std::equal_to;
using std::greater;
using std::greater_equal;
using std::less;
using std::less_equal;
using std::logical_and;
using std::logical_not;
using std::logical_or;
using std::mem_fun;
using std::mem_fun_ref;
using std::mem_fun_ref_t;
using std::mem_fun_t;
using std::minus;
using std::modulus;
using std::multiplies;
using std::negate;
using std::not1;
using std::not2;
using std::not_equal_to;
using std::plus;
using std::pointer_to_binary_function;
using std::pointer_to_unary_function;
using std::ptr_fun;
using std::unary_function;
using std::unary_negate;

#endif
