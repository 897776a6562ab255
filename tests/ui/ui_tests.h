#pragma once
// All tests of the window are one program, which compiles and links in half the time of one a file. Each file's class
// runs in a process of its own: `ui_tests test_alarm [QTest's arguments]`.
#include <QObject>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace btr::ui::tests {

using Maker = std::function<std::unique_ptr<QObject>()>;

/// By the name of their file, without what follows the point.
std::map<std::string, Maker>& uiTests();

/// Enters a class; the value says nothing.
bool enterUiTest(const std::string& file, Maker maker);

}  // namespace btr::ui::tests

/// At the end of a file, in the place of QTEST_MAIN.
#define UI_TEST(Class)                           \
  [[maybe_unused]] static const bool isEntered = \
      btr::ui::tests::enterUiTest(__FILE__, [] { return std::make_unique<Class>(); });
